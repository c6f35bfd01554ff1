/* Links that are fixed to the base or to another link, beside base and kin_link_names. */
extern const char *const kin_frame_names[KIN_FRAMES];
/* The pose in the base frame of one of these, by its place in kin_frame_names: 0, or
 * KIN_NO_SUCH_FRAME. */
int kin_fk_frame(const double q[KIN_JOINTS], int frame, double pose[12]);
