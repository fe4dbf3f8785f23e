# The tests that are valid for any robot; a board whose robot has no tests of its own runs these. The others are written
# for the FER or the UR10.
ANY_ROBOT := $(wildcard tests/model/test_*.cpp) $(patsubst %,tests/%.cpp, \
  $(addprefix sim_plant/arm/test_,servo sim_drives sim_hal sim_plant) \
  control/test_admittance control/test_cartesian_brake control/test_cartesian_lag control/test_cartesian_pose \
  control/test_cartesian_singularities control/test_pid control/test_retune \
  gateway/trajectory/test_joint_turns \
  guard/test_collision guard/test_collision_credit guard/test_collision_never guard/test_collision_rules \
  guard/test_collision_spread guard/test_collision_timing \
  guard/test_convex guard/test_convex_scene guard/test_guard_motion guard/test_separation guard/test_stopping \
  load/test_board_sections load/test_collision_file math/test_joint_integrator \
  pipeline/test_closed_loop pipeline/test_collision_lateness pipeline/test_collision_pipelines \
  pipeline/test_contact_pipelines \
  pipeline/test_free_pipelines pipeline/test_pipelines pipeline/test_recordings pipeline/test_room pipeline/test_stops \
  pipeline/test_tuning program/test_reach program/test_sections \
  reference/generator/test_start_times streams/test_chunk_properties reference/motion/test_every_motion \
  reference/motion/test_motion)
# Of these, those that reach lines with six joints which they do not reach with seven, and what is about the board. A
# sanitizer sees the others with the FER.
OF_EACH := $(patsubst %,tests/%.cpp, \
  control/test_cartesian_brake control/test_cartesian_lag control/test_cartesian_pose control/test_cartesian_singularities \
  pipeline/test_pipelines program/test_reach program/test_sections)
