# The rules of modules, which scripts/module_rules.py states and checks: it reads the calls below from the CMakeLists.txt
# files themselves, so that other scripts know modules and folders without a configuration.
find_program(THRONG_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(THRONG_PYTHON python3 REQUIRED)
set(THRONG_MODULE_RULES "${CMAKE_CURRENT_LIST_DIR}/../scripts/module_rules.py")

# throng_folder(FOLDER PURPOSE [USES folder...]): a folder of the module whose CMakeLists.txt this is, what it is for, and
# the folders declared before it whose headers it includes. Every folder is declared, the module's own one (".") above those
# that it includes and below those that include it.
function(throng_folder)
endfunction()

# throng_allow_private(FILE header...): an exception for a test or benchmark; paths are relative to the source folder.
function(throng_allow_private)
endfunction()

# throng_check_modules(): stops the configuration when a rule is broken, with all violations as FILE:LINE: what is wrong and
# what is allowed.
function(throng_check_modules)
  get_property(declared GLOBAL PROPERTY THRONG_DECLARED_MODULES)
  execute_process(COMMAND "${THRONG_PYTHON}" "${THRONG_MODULE_RULES}" check "${PROJECT_SOURCE_DIR}" ${declared}
    RESULT_VARIABLE code ERROR_VARIABLE violations)
  if(code)
    message(FATAL_ERROR "${violations}")
  endif()
endfunction()

# The headers that other programs need of a module: the public ones, and those of the module that they include.
function(throng_interface_headers module result)
  execute_process(COMMAND "${THRONG_PYTHON}" "${THRONG_MODULE_RULES}" headers "${PROJECT_SOURCE_DIR}" ${module}
    OUTPUT_VARIABLE headers OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" headers "${headers}")
  set(${result} "${headers}" PARENT_SCOPE)
endfunction()
