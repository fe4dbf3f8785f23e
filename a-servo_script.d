servo_script.o: sim_plant/ur/servo_script.cpp \
 sim_plant/ur/servo_script.hpp sim_plant/ur/servo_law.hpp \
 sim_plant/ur/script_expression.hpp sim_plant/ur/script_text.hpp \
 kernel/types.hpp kernel/model/robot.hpp kernel/model/ur10.hpp \
 kernel/model/robot_table.hpp
sim_plant/ur/servo_script.hpp:
sim_plant/ur/servo_law.hpp:
sim_plant/ur/script_expression.hpp:
sim_plant/ur/script_text.hpp:
kernel/types.hpp:
kernel/model/robot.hpp:
kernel/model/ur10.hpp:
kernel/model/robot_table.hpp:
