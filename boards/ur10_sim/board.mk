# A simulated Universal Robots UR10 (CB3) in virtual time, on the host.
ROBOT  := UR10
SRCS   += boards/ur10_sim/board.cpp
LDLIBS += -lmujoco

# What `make run` runs: pipeline, or pipeline:trajectory.
RUNS   += ur10_jrg_pdgc ur10_jrg_pid ur10_jrg_pid:ur10_five_waypoints_quintic
RUNS   += ur10_trg_cpc ur10_trg_cpc:ur10_square_at_rest ur10_trg_cpc_125 ur10_trg_ac_cpc ur10_trg_ac_cpc_pid

# The tests that are not written for the FER.
TESTS  := model_against_kdl model_agreement model_mechanics robot_model sim_plant sim_hal servo closed_loop
TESTS  += admittance cartesian_pose cartesian_lag cartesian_brake cartesian_singularities damped_inverse joint_motion pid guard_motion motion start_times every_motion
TESTS  += pipelines free_pipelines contact_pipelines stops
TESTS  += collision collision_rules collision_file collision_pipelines separation stopping

# Memory in bytes that `make certificate` holds the kernel to: static and stack on a Cortex-M7, an exception included,
# and stack on the host.
STATIC_BUDGET     := 262144
STACK_BUDGET      := 24576
HOST_STACK_BUDGET := 32768
