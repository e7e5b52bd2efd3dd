# Every dependency is a package of Debian 12 and Ubuntu 24.04; one line each on why it is here.
find_package(Eigen3 3.4 REQUIRED)     # vectors, small matrices and decompositions
find_package(fmt REQUIRED)            # text formatting (g++ 12 has no std::format)
find_package(TBB REQUIRED)            # parallel loops and the ordered frame pipeline
find_package(PNG REQUIRED)            # PNG decoding and encoding, 8 and 16 bit
find_package(ZLIB REQUIRED)            # CRC-32 of the files of a map
find_package(PkgConfig REQUIRED)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)  # JPEG, straight to grey where colour is not needed
find_package(yaml-cpp REQUIRED)       # camera.yaml and configuration files
find_package(nlohmann_json REQUIRED)  # run.json, map.json and --json
find_package(Ceres REQUIRED)          # pose graph
find_package(octomap REQUIRED)        # .bt and .ot files
pkg_check_modules(geographiclib REQUIRED IMPORTED_TARGET geographiclib)  # latitude, longitude, height to east, north, up
find_package(CLI11 REQUIRED)          # the command line

# OpenCV: detectors and descriptors chosen by name. Its CMake package comes only with libopencv-dev, which pulls in
# VTK and all modules; the three that we use are found by hand.
find_path(OPENCV_INCLUDE_DIR opencv2/features2d.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(cairn_opencv INTERFACE)
target_include_directories(cairn_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module core imgproc features2d)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  target_link_libraries(cairn_opencv INTERFACE ${OPENCV_${module}_LIBRARY})
endforeach()

if(CAIRN_TESTS OR CAIRN_BENCHMARKS)
  find_package(GTest REQUIRED)        # unit tests
endif()
