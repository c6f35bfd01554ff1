
/* No chain has more solutions. */
#define KIN_MOST 16

/* The solutions of a target, chain by chain: once the platform's place is known, the chains do not
 * know of each other, and every combination of their solutions for one place is a configuration. */
typedef struct kin_postures {
    /* Row b has the b-th solution of every chain, and for which place it is. */
    double q[KIN_MOST][KIN_JOINTS];
    int places[KIN_CHAINS][KIN_MOST];
    int counts[KIN_CHAINS];
} kin_postures;

/* All configurations that hold the platform at a target: how many there are. Limits are not
 * applied. */
int kin_ik(const double pose[12], kin_postures *postures);
/* The same; a joint that a singular target leaves free keeps its value in the seed. */
int kin_ik_seeded(const double pose[12], const double seed[KIN_JOINTS], kin_postures *postures);
/* How many configurations there are, and one of them by its number: 1, or 0 if there are fewer. */
int kin_count(const kin_postures *postures);
int kin_posture(const kin_postures *postures, int number, double q[KIN_JOINTS]);
/* The configuration that moves the joints of each chain least from the seed, within the limits, with
 * full turns where these lead there. 1, or 0 where there is none. */
int kin_ik_nearest(const double pose[12], const double seed[KIN_JOINTS], double q[KIN_JOINTS]);
