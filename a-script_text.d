script_text.o: sim_plant/ur/script_text.cpp sim_plant/ur/script_text.hpp \
 kernel/types.hpp kernel/model/robot.hpp kernel/model/ur10.hpp \
 kernel/model/robot_table.hpp
sim_plant/ur/script_text.hpp:
kernel/types.hpp:
kernel/model/robot.hpp:
kernel/model/ur10.hpp:
kernel/model/robot_table.hpp:
