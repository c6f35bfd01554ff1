//! The six-revolute structures with a decomposition into subproblems, and
//! their mirror images.
//!
//! The rows are those of the tables by A. Elias and J. Wen, "IK-Geo: Unified
//! robot inverse kinematics using subproblem decomposition", 2022, and D.
//! Ostermeier, J. Külz and M. Althoff, "Automatic geometric decomposition for
//! analytical inverse kinematics", 2025.

table! {
    wrist_behind_2_parallel_3: [SKEW, SKEW, PARALLEL, SKEW, MEET, MEET_THERE];
    wrist_behind_1_meeting_2: [SKEW, MEET, SKEW, SKEW, MEET, MEET_THERE];
    wrist_behind_1_parallel_2: [SKEW, PARALLEL, SKEW, SKEW, MEET, MEET_THERE];
    wrist_behind_2_meeting_3: [SKEW, SKEW, MEET, SKEW, MEET, MEET_THERE];
    wrist_alone: [SKEW, SKEW, SKEW, SKEW, MEET, MEET_THERE];
    parallel_234_and_5_meeting_6: [SKEW, SKEW, PARALLEL, PARALLEL, SKEW, MEET];
    parallel_234: [SKEW, SKEW, PARALLEL, PARALLEL, SKEW, SKEW];
    parallel_123_and_5_meeting_6: [SKEW, PARALLEL, PARALLEL, SKEW, SKEW, MEET];
    parallel_123: [SKEW, PARALLEL, PARALLEL, SKEW, SKEW, SKEW];
    concurrent_345: [SKEW, SKEW, SKEW, MEET, MEET_THERE, SKEW];
}
