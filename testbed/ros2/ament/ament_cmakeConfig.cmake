# What a package asks of ament_cmake, in as few lines as CMake takes to install it.

function(ament_environment_hooks)
  foreach(hook ${ARGN})
    get_filename_component(name "${hook}" NAME)
    string(REGEX REPLACE "\\.in$" "" name "${name}")
    configure_file("${hook}" "${CMAKE_CURRENT_BINARY_DIR}/${name}" @ONLY)
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}" DESTINATION share/${PROJECT_NAME}/environment)
  endforeach()
endfunction()

function(ament_package)
  install(FILES package.xml DESTINATION share/${PROJECT_NAME})
endfunction()
