# Writes the identity of the sources below SOURCE_DIR into HEADER if the identity has changed. Commands and pages are not part
# of it, so flights remain valid when only these change.
cmake_minimum_required(VERSION 3.25)
set(folders scenes vision dynamics avoidance sim cmake)
set(observers sim/cli sim/flightlog sim/pages)  # no other folder may include them
# Editors and Python add other files, which must not change the identity.
set(source "/([^./][^/]*[.](cmake|cpp|css|h|html|in|js|json|py|pyi|txt|typed)|[.]npmrc)$")
set(generated "/(node_modules|__pycache__|[.][^/]+)/")
string(REGEX REPLACE "([[*?])" "[\\1]" pattern "${SOURCE_DIR}")  # the folder's name is no pattern
set(files "")
foreach(folder IN LISTS folders)
  file(GLOB_RECURSE found LIST_DIRECTORIES false RELATIVE "${SOURCE_DIR}" "${pattern}/${folder}/*")
  list(FILTER found INCLUDE REGEX "${source}")
  list(FILTER found EXCLUDE REGEX "${generated}")
  if(NOT found)
    message(FATAL_ERROR "${SOURCE_DIR}/${folder} has no sources; the identity of the build requires all of them")
  endif()
  list(APPEND files ${found})
endforeach()
set(lists CMakeLists.txt CMakePresets.json)
list(APPEND files ${lists})
list(JOIN observers "|" pattern)
list(FILTER files EXCLUDE REGEX "^(${pattern})/")
list(SORT files)
set(text "${COMPILER}\n${FLAGS}\n")
foreach(file IN LISTS files)
  file(SHA256 "${SOURCE_DIR}/${file}" hash)
  string(APPEND text "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 16 hash)

# The last commit that changed these sources; empty outside a git checkout.
set(commit "")
find_program(git git)
if(git AND EXISTS "${SOURCE_DIR}/.git")
  list(TRANSFORM observers PREPEND ":(exclude)")
  execute_process(COMMAND ${git} -C "${SOURCE_DIR}" log -1 --abbrev=10 --format=%h -- ${folders} ${lists} ${observers}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${git} -C "${SOURCE_DIR}" status --porcelain --untracked-files=all -- ${folders} ${lists} ${observers}
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  string(REGEX REPLACE "\n" ";" changes "${changes}")
  list(TRANSFORM changes REPLACE "^.. " "/")
  list(FILTER changes INCLUDE REGEX "${source}")
  list(FILTER changes EXCLUDE REGEX "${generated}")
  if(commit AND changes)
    string(APPEND commit " and changes")
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT
"#pragma once

#define HEDGEHOP_VERSION \"@VERSION@\"
#define HEDGEHOP_BUILD \"@hash@\"
#define HEDGEHOP_COMMIT \"@commit@\"
#define HEDGEHOP_COMPILER \"@COMPILER@\"
")
