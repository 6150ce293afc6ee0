# SPDX-License-Identifier: BSD-3-Clause
# The target akimap_rosbag, and AKIMAP_ROSBAG in the cache, where Debian's reader of ROS 1 bags is
# installed: librosbag-storage-dev, libsensor-msgs-dev, libnav-msgs-dev, libtf2-msgs-dev. Its own
# CMake and pkg-config files ask for packages that do not exist.
option(AKIMAP_ROSBAG_WANTED "Read ROS 1 bags if librosbag-storage-dev is installed" ON)
set(found ${AKIMAP_ROSBAG_WANTED})
set(headers "")
set(libraries "")
foreach(header rosbag/bag.h sensor_msgs/PointCloud2.h nav_msgs/Odometry.h tf2_msgs/TFMessage.h
               pluginlib/class_loader.hpp class_loader/class_loader.hpp rcutils/macros.h
               rcpputils/shared_library.hpp ament_index_cpp/get_package_prefix.hpp)
  get_filename_component(folder ${header} DIRECTORY)
  find_path(ROSBAG_${folder}_HEADERS ${header} PATH_SUFFIXES ${folder})
  mark_as_advanced(ROSBAG_${folder}_HEADERS)
  list(APPEND headers ${ROSBAG_${folder}_HEADERS})
  if(NOT ROSBAG_${folder}_HEADERS)
    set(found OFF)
  endif()
endforeach()
foreach(library rosbag_storage roscpp_serialization rostime cpp_common console_bridge)
  find_library(ROSBAG_${library} ${library})
  mark_as_advanced(ROSBAG_${library})
  list(APPEND libraries ${ROSBAG_${library}})
  if(NOT ROSBAG_${library})
    set(found OFF)
  endif()
endforeach()
set(AKIMAP_ROSBAG ${found} CACHE INTERNAL "ROS 1 bags can be read")
message(STATUS "ROS 1 bags: ${AKIMAP_ROSBAG}")
if(AKIMAP_ROSBAG)
  add_library(akimap_rosbag INTERFACE)
  target_include_directories(akimap_rosbag SYSTEM INTERFACE ${headers})
  target_link_libraries(akimap_rosbag INTERFACE ${libraries})
endif()
