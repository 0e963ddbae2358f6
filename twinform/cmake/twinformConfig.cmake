# The CMake package of twinform: models are converted while a package is built, and checked by its tests.
#
#   execute_process(COMMAND twinform --cmake-dir OUTPUT_VARIABLE twinform_DIR OUTPUT_STRIP_TRAILING_WHITESPACE)
#   find_package(twinform REQUIRED)
#   twinform_convert(urdf/robot.urdf.xacro TO sdf DESTINATION share/${PROJECT_NAME}/models)
#   if(BUILD_TESTING)
#     twinform_check(urdf/robot.urdf.xacro)
#   endif()

if(CMAKE_VERSION VERSION_LESS 3.20)
  set(twinform_FOUND FALSE)
  set(twinform_NOT_FOUND_MESSAGE "twinform needs CMake 3.20, whose rules read files of dependencies")
  return()
endif()

# first the command of the environment that this file is in, such as .venv/lib/python3.12/site-packages/twinform/cmake
find_program(TWINFORM_EXECUTABLE twinform
  HINTS "${CMAKE_CURRENT_LIST_DIR}/../../../../../bin" "${CMAKE_CURRENT_LIST_DIR}/../../../../Scripts"
  DOC "The command twinform")
if(NOT TWINFORM_EXECUTABLE)
  set(twinform_FOUND FALSE)
  set(twinform_NOT_FOUND_MESSAGE "the command twinform is not found: set TWINFORM_EXECUTABLE, or PATH")
  return()
endif()

# twinform_convert(MODEL TO sdf|urdf|mjcf [OUTPUT FILE] [DESTINATION FOLDER] [OPTIONS OPTION...])
#
# Build the file in another format, again whenever MODEL, a file that it includes, or the settings of its project
# change. Without OUTPUT it is called like MODEL, with .xml for MJCF, in the build folder of this directory; DESTINATION
# is where it is installed. OPTIONS are those of `twinform convert`, and arguments of xacro, NAME:=VALUE.
function(twinform_convert model)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TO;OUTPUT;DESTINATION" "OPTIONS")
  _twinform_require_words(twinform_convert "${arg_UNPARSED_ARGUMENTS}" "${arg_KEYWORDS_MISSING_VALUES}")
  if(NOT arg_TO MATCHES "^(sdf|urdf|mjcf)$")
    message(FATAL_ERROR "twinform_convert: TO is '${arg_TO}'; expected sdf, urdf or mjcf")
  endif()
  _twinform_find_input(twinform_convert "${model}" input)

  get_filename_component(name "${input}" NAME)
  string(REGEX REPLACE "(\\.(urdf|sdf|world|xml|mjcf|xacro))+$" "" name "${name}")
  if(NOT arg_OUTPUT)
    set(ending "${arg_TO}")
    if(arg_TO STREQUAL "mjcf")
      set(ending "xml")
    endif()
    set(arg_OUTPUT "${name}.${ending}")
  endif()
  get_filename_component(output "${arg_OUTPUT}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  get_filename_component(folder "${output}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")

  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${TWINFORM_EXECUTABLE}" convert "${input}" -o "${output}" --to "${arg_TO}" --depfile "${output}.d"
      --keep-paths ${arg_OPTIONS}
    DEPENDS "${input}" "${TWINFORM_EXECUTABLE}"
    DEPFILE "${output}.d"
    COMMENT "Converting ${model} to ${arg_TO}"
    VERBATIM)
  # names of targets have fewer characters than names of files
  string(MAKE_C_IDENTIFIER "twinform_${PROJECT_NAME}_${arg_OUTPUT}" target)
  add_custom_target("${target}" ALL DEPENDS "${output}")
  if(arg_DESTINATION)
    install(FILES "${output}" DESTINATION "${arg_DESTINATION}")
  endif()
endfunction()

# twinform_check(MODEL_OR_FOLDER... [NAME NAME] [OPTIONS OPTION...])
#
# Add a test that fails where `twinform check` finds an error. OPTIONS are those of the command, such as --deny warnings.
function(twinform_check)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "OPTIONS")
  _twinform_require_words(twinform_check "" "${arg_KEYWORDS_MISSING_VALUES}")
  if(NOT arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "twinform_check: there is nothing to check; name a model or a folder")
  endif()
  set(inputs "")
  foreach(model IN LISTS arg_UNPARSED_ARGUMENTS)
    _twinform_find_input(twinform_check "${model}" input)
    list(APPEND inputs "${input}")
  endforeach()
  if(NOT arg_NAME)
    list(JOIN arg_UNPARSED_ARGUMENTS " " arg_NAME)
    set(arg_NAME "twinform_check ${arg_NAME}")
  endif()
  add_test(NAME "${arg_NAME}" COMMAND "${TWINFORM_EXECUTABLE}" check ${inputs} ${arg_OPTIONS}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
endfunction()

function(_twinform_require_words function unknown valueless)
  if(unknown)
    message(FATAL_ERROR "${function}: '${unknown}' is none of its keywords, nor a value of one")
  elseif(valueless)
    message(FATAL_ERROR "${function}: ${valueless} has no value")
  endif()
endfunction()

function(_twinform_find_input function model result)
  get_filename_component(input "${model}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  get_source_file_property(is_made "${input}" GENERATED)
  if(NOT EXISTS "${input}" AND NOT is_made)
    message(FATAL_ERROR "${function}: there is no file ${model} in ${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  set("${result}" "${input}" PARENT_SCOPE)
endfunction()
