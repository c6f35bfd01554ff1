static int kin_is_actuated(int joint)
{
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        if (kin_actuated[a] == joint) {
            return 1;
        }
    }
    return 0;
}
