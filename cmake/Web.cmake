# Scripts of web/, bundled by esbuild and embedded in the program: those of HTML reports while CMake configures, Studio (the
# page of the service) while it builds.

# Installs the packages of web/package-lock.json, once for all builds of this tree; needs npm's registry then only. Packages that
# only the checks need (devDependencies: linters, a browser's driver) come with the tests.
function(throng_web_packages)
  set(folder "${PROJECT_SOURCE_DIR}/build/web")
  set(lock "${PROJECT_SOURCE_DIR}/web/package-lock.json")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${lock}")
  file(SHA256 "${lock}" wanted)
  set(omitted "")
  if(NOT BUILD_TESTING)
    set(omitted --omit=dev)
  endif()
  set(installed "")
  if(EXISTS "${folder}/installed.sha256")
    file(READ "${folder}/installed.sha256" installed)
  endif()
  if(installed STREQUAL "${wanted}" OR (omitted AND installed STREQUAL "${wanted} ${omitted}"))
    return()
  endif()
  find_program(NPM_PROGRAM npm)
  if(NOT NPM_PROGRAM)
    message(FATAL_ERROR "npm is missing, which fetches the libraries of web/ (Debian package npm; scripts/setup.sh installs it)")
  endif()
  message(STATUS "Fetching the packages of web/package-lock.json")
  file(COPY "${PROJECT_SOURCE_DIR}/web/package.json" "${lock}" DESTINATION "${folder}")
  execute_process(COMMAND "${NPM_PROGRAM}" ci ${omitted} --ignore-scripts --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY "${folder}" RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "npm could not install the packages of web/package-lock.json (a first build needs npm's registry):\n${output}")
  endif()
  string(STRIP "${wanted} ${omitted}" installed)
  file(WRITE "${folder}/installed.sha256" "${installed}")
endfunction()

# throng_bundle(TARGET SYMBOL FILE): FILE of web/, a script or a style sheet, and all that it imports, embedded like
# throng_embed's text.
function(throng_bundle target symbol file)
  throng_web_packages()
  find_program(NODE_PROGRAM NAMES node nodejs REQUIRED)
  set(packages "${PROJECT_SOURCE_DIR}/build/web/node_modules")
  get_filename_component(extension "${file}" EXT)
  set(bundle "${CMAKE_CURRENT_BINARY_DIR}/${symbol}${extension}")
  # Reports and Studio share charts and colors.
  set(web "${PROJECT_SOURCE_DIR}/web")
  file(GLOB sources CONFIGURE_DEPENDS "${web}/*.js" "${web}/*.css" "${web}/studio/charts/*")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources} "${web}/studio/run/exit_states.ts"
    "${web}/studio/styles/colors.css" "${web}/studio/styles/charts.css")
  set(script_options "")
  if(extension STREQUAL ".js")
    set(script_options --format=iife --target=es2020 --jsx=automatic --jsx-import-source=preact
      "--banner:js=/*! Apache ECharts (Apache License 2.0) with zrender (BSD 3-Clause), Preact (MIT License) and throng */")
  endif()
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E env "NODE_PATH=${packages}" "${NODE_PROGRAM}" "${packages}/esbuild/bin/esbuild"
      "${web}/${file}" --bundle --minify --charset=ascii --log-level=warning --legal-comments=none ${script_options} "--outfile=${bundle}"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "esbuild could not bundle web/${file}:\n${output}")
  endif()
  throng_embed(${target} ${symbol} "${bundle}")
endfunction()

# throng_studio(TARGET): web/studio as files of a web page, in TARGET as throng::embedded::kStudio (server/api/studio.h).
function(throng_studio target)
  throng_web_packages()
  find_program(NODE_PROGRAM NAMES node nodejs REQUIRED)
  set(packages "${PROJECT_SOURCE_DIR}/build/web/node_modules")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/web/studio/*" "${PROJECT_SOURCE_DIR}/scenarios/*.job.json")
  set(output "${CMAKE_CURRENT_BINARY_DIR}/studio")
  add_custom_command(OUTPUT "${output}/studio_files.cpp" "${output}/studio_bytes.S"
    COMMAND "${CMAKE_COMMAND}" -E env "NODE_PATH=${packages}" "${NODE_PROGRAM}" "${PROJECT_SOURCE_DIR}/web/studio/build.mjs"
      "${packages}" "${output}"
    DEPENDS ${sources} "${PROJECT_SOURCE_DIR}/web/package-lock.json" "${PROJECT_SOURCE_DIR}/NOTICE"
    COMMENT "Bundling web/studio" VERBATIM)
  target_sources(${target} PRIVATE "${output}/studio_files.cpp" "${output}/studio_bytes.S")
  target_include_directories(${target} PRIVATE "${output}")
  set_source_files_properties("${output}/studio_files.cpp" PROPERTIES
    SKIP_UNITY_BUILD_INCLUSION ON)
  # .incbin is invisible to the build: the assembler's file is written again with every change of the bytes.
  set_source_files_properties("${output}/studio_bytes.S" PROPERTIES LANGUAGE ASM)
endfunction()
