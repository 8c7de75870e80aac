# Every third-party library, once. All of them are Debian packages listed in scripts/packages.txt.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)  # headers only: Asio, Beast, Geometry, Math
find_package(TBB REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(CURL 7.87 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(assimp REQUIRED)
find_package(PNG REQUIRED)
find_package(SQLite3 REQUIRED)
find_package(SQLiteCpp REQUIRED)
find_package(LibArchive REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
find_package(meshoptimizer REQUIRED)
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(isal REQUIRED IMPORTED_TARGET libisal)
pkg_check_modules(libdeflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(libzstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(libexif REQUIRED IMPORTED_TARGET libexif)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(pangocairo REQUIRED IMPORTED_TARGET pangocairo)
# Without its -pthread, which does nothing here but keep precompiled headers from being used.
set_target_properties(PkgConfig::pangocairo PROPERTIES INTERFACE_COMPILE_OPTIONS "")
pkg_check_modules(seccomp REQUIRED IMPORTED_TARGET libseccomp)
find_package(valijson REQUIRED)

# Debian's Recast comes without files for CMake.
add_library(throng_recast INTERFACE)
find_library(RECAST_LIBRARY Recast REQUIRED)
find_path(RECAST_INCLUDE Recast.h PATH_SUFFIXES recastnavigation REQUIRED)
target_link_libraries(throng_recast INTERFACE "${RECAST_LIBRARY}")
target_include_directories(throng_recast SYSTEM INTERFACE "${RECAST_INCLUDE}")

# The file for CMake asks for Ignition's own, the one for pkg-config for C++17.
add_library(throng_sdformat INTERFACE)
foreach(library IN ITEMS sdformat12 ignition-math6 console_bridge)
  find_library(LIBRARY_${library} ${library} REQUIRED)
  target_link_libraries(throng_sdformat INTERFACE "${LIBRARY_${library}}")
endforeach()
find_path(SDFORMAT_INCLUDE sdf/sdf.hh PATH_SUFFIXES sdformat-12.3 REQUIRED)
find_path(IGNITION_MATH_INCLUDE ignition/math/Pose3.hh PATH_SUFFIXES ignition/math6 REQUIRED)
find_path(IGNITION_UTILS_INCLUDE ignition/utils/ImplPtr.hh PATH_SUFFIXES ignition/utils1 REQUIRED)
target_include_directories(throng_sdformat SYSTEM INTERFACE
  "${SDFORMAT_INCLUDE}" "${IGNITION_MATH_INCLUDE}" "${IGNITION_UTILS_INCLUDE}")

# The file for CMake names no target.
add_library(throng_embree INTERFACE)
find_library(EMBREE_LIBRARY embree3 REQUIRED)
find_path(EMBREE_INCLUDE embree3/rtcore.h REQUIRED)
target_link_libraries(throng_embree INTERFACE "${EMBREE_LIBRARY}")
target_include_directories(throng_embree SYSTEM INTERFACE "${EMBREE_INCLUDE}")

# Camera files of ROS, OpenCV and Kalibr.
find_package(yaml-cpp 0.7 REQUIRED)
add_library(throng_yaml INTERFACE)
target_link_libraries(throng_yaml INTERFACE yaml-cpp)

# Headers only; OSM's XML is read by Expat.
find_package(EXPAT REQUIRED)
add_library(throng_osmium INTERFACE)
find_path(OSMIUM_INCLUDE osmium/osm.hpp REQUIRED)
target_include_directories(throng_osmium SYSTEM INTERFACE "${OSMIUM_INCLUDE}")
target_link_libraries(throng_osmium INTERFACE EXPAT::EXPAT Threads::Threads)

find_package(Ceres 2.1 REQUIRED)
add_library(throng_ceres INTERFACE)
target_link_libraries(throng_ceres INTERFACE Ceres::ceres)

# Only these modules: Debian's CMake files come with all of OpenCV, which is ten times the size.
add_library(throng_opencv INTERFACE)
foreach(module IN ITEMS core imgproc)
  find_library(OPENCV_${module} opencv_${module} REQUIRED)
  target_link_libraries(throng_opencv INTERFACE "${OPENCV_${module}}")
endforeach()
find_path(OPENCV_INCLUDE opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
target_include_directories(throng_opencv SYSTEM INTERFACE "${OPENCV_INCLUDE}")

# OpenCV's modules for the detection of calibration boards, for the one module that uses them. ArUco is linked statically:
# Debian's shared one is a part of libopencv-contrib, which comes with GDAL, Qt and Tesseract (150 packages).
add_library(throng_opencv_calib INTERFACE)
find_library(OPENCV_aruco libopencv_aruco.a REQUIRED)
target_link_libraries(throng_opencv_calib INTERFACE "${OPENCV_aruco}")
foreach(module IN ITEMS calib3d features2d flann)
  find_library(OPENCV_${module} opencv_${module} REQUIRED)
  target_link_libraries(throng_opencv_calib INTERFACE "${OPENCV_${module}}")
endforeach()
target_link_libraries(throng_opencv_calib INTERFACE throng_opencv)
# Only for tests, whose oracle it is: it loads GDAL, some 70 libraries, which took 0.1 s of every process.
if(BUILD_TESTING)
  add_library(throng_opencv_imgcodecs INTERFACE)
  find_library(OPENCV_imgcodecs opencv_imgcodecs REQUIRED)
  target_link_libraries(throng_opencv_imgcodecs INTERFACE "${OPENCV_imgcodecs}" throng_opencv)
endif()
