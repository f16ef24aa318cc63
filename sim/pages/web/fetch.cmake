# cmake -DNPM=... -DSOURCE=dir -DBUILD=dir -P fetch.cmake: installs the locked npm packages into the build folder.
file(MAKE_DIRECTORY "${BUILD}")
foreach(file package.json package-lock.json .npmrc)
  file(COPY "${SOURCE}/${file}" DESTINATION "${BUILD}")
endforeach()
execute_process(COMMAND "${NPM}" ci --no-audit --no-fund --ignore-scripts --prefer-offline --loglevel=error
                WORKING_DIRECTORY "${BUILD}" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "npm could not fetch the packages of ${SOURCE}/package-lock.json. It needs the npm registry once. "
                      "Output of npm:
${output}")
endif()
