# SPDX-License-Identifier: Apache-2.0
# cmake -DIDL=<in> -DOUT=<out> -P adapt.cmake
# One of our IDL files as a vendor's own compiler needs it to give ROS 2's type names on the wire:
# pkg::msg::dds_::Name_. fastddsgen does this by an option, Cyclone DDS has none.
file(READ ${IDL} text)
string(REGEX REPLACE "(^|\n)module msg {" "\\1module msg { module dds_ {" text "${text}")
string(REGEX REPLACE "(^|\n)struct ([A-Za-z0-9]+)" "\\1struct \\2_" text "${text}")
string(REGEX REPLACE "::msg::([A-Za-z0-9]+)" "::msg::dds_::\\1_" text "${text}")
string(REGEX REPLACE "\n#endif" "\n};\n#endif" text "${text}")
file(WRITE ${OUT} "${text}")
