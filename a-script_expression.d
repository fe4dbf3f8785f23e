script_expression.o: sim_plant/ur/script_expression.cpp \
 sim_plant/ur/script_expression.hpp sim_plant/ur/script_text.hpp \
 kernel/types.hpp kernel/model/robot.hpp kernel/model/ur10.hpp \
 kernel/model/robot_table.hpp sim_plant/ur/script_functions.hpp \
 sim_plant/ur/machine.hpp sim_plant/ur/body.hpp sim_plant/arm.hpp \
 kernel/status.hpp sim_plant/plant_params.hpp kernel/describe.hpp \
 sim_plant/robot_mjcf.hpp sim_plant/ur10_mjcf.hpp sim_plant/scene.hpp \
 sim_plant/contact.hpp sim_plant/tip_contact.hpp \
 sim_plant/ur/kinematics.hpp sim_plant/ur/io.hpp \
 sim_plant/ur/rtde_fields.hpp sim_plant/ur/image.hpp hal/ur/protocol.hpp \
 hal/ur/protocol_bytes.hpp hal/ur/protocol_frames.hpp \
 hal/ur/protocol_modes.hpp hal/ur/protocol_rtde.hpp \
 hal/ur/protocol_script.hpp hal/ur/protocol_state.hpp \
 sim_plant/ur/links.hpp sim_plant/ur/outbox.hpp sim_plant/ur/power.hpp \
 sim_plant/ur/settings.hpp sim_plant/ur/motion.hpp \
 sim_plant/ur/safety_codes.hpp sim_plant/ur/servo_law.hpp \
 sim_plant/ur/trapezoid.hpp sim_plant/ur/robot_messages.hpp \
 sim_plant/ur/safety.hpp sim_plant/ur/script_operators.hpp
sim_plant/ur/script_expression.hpp:
sim_plant/ur/script_text.hpp:
kernel/types.hpp:
kernel/model/robot.hpp:
kernel/model/ur10.hpp:
kernel/model/robot_table.hpp:
sim_plant/ur/script_functions.hpp:
sim_plant/ur/machine.hpp:
sim_plant/ur/body.hpp:
sim_plant/arm.hpp:
kernel/status.hpp:
sim_plant/plant_params.hpp:
kernel/describe.hpp:
sim_plant/robot_mjcf.hpp:
sim_plant/ur10_mjcf.hpp:
sim_plant/scene.hpp:
sim_plant/contact.hpp:
sim_plant/tip_contact.hpp:
sim_plant/ur/kinematics.hpp:
sim_plant/ur/io.hpp:
sim_plant/ur/rtde_fields.hpp:
sim_plant/ur/image.hpp:
hal/ur/protocol.hpp:
hal/ur/protocol_bytes.hpp:
hal/ur/protocol_frames.hpp:
hal/ur/protocol_modes.hpp:
hal/ur/protocol_rtde.hpp:
hal/ur/protocol_script.hpp:
hal/ur/protocol_state.hpp:
sim_plant/ur/links.hpp:
sim_plant/ur/outbox.hpp:
sim_plant/ur/power.hpp:
sim_plant/ur/settings.hpp:
sim_plant/ur/motion.hpp:
sim_plant/ur/safety_codes.hpp:
sim_plant/ur/servo_law.hpp:
sim_plant/ur/trapezoid.hpp:
sim_plant/ur/robot_messages.hpp:
sim_plant/ur/safety.hpp:
sim_plant/ur/script_operators.hpp:
