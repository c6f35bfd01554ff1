
/* One assembly. */
typedef struct kin_assembly {
    double q[KIN_JOINTS];
    /* How far the loops are from closed, metres. */
    double residual;
    /* Which of the assembly modes this is, as branches of an arm are numbered. */
    int branch;
    /* Not 0 where two modes have met. */
    int singular;
} kin_assembly;

/* All assemblies with the given values of the actuated joints: how many there are. Of the ways to
 * hold one platform pose with the same actuated joints, the nearest to zero stands for all. */
int kin_fk(const double actuated[KIN_ACTUATED], kin_assembly assemblies[KIN_ASSEMBLY_MODES]);
