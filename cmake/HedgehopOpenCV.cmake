include_guard()
# The OpenCV modules in use, each from its own package: Debian's OpenCVConfig.cmake comes with all of OpenCV, 600 MB more.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)

# hedgehop_opencv(<module> [REQUIRED])
function(hedgehop_opencv module)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} ${ARGN})
  if(OPENCV_${module}_LIBRARY)
    add_library(opencv_${module} INTERFACE IMPORTED GLOBAL)
    target_link_libraries(opencv_${module} INTERFACE ${OPENCV_${module}_LIBRARY})
    target_include_directories(opencv_${module} SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
  endif()
endfunction()
foreach(module core imgproc calib3d video)
  hedgehop_opencv(${module} REQUIRED)
endforeach()
hedgehop_opencv(dnn)  # for onnx_policy
hedgehop_opencv(imgcodecs)  # for the tests, and for loops of one's own
