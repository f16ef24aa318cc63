# Writes HEADER with the identity of the sources below SOURCE_DIR, only where it differs from what is there.
cmake_minimum_required(VERSION 3.25)
set(folders scenes vision dynamics avoidance sim cmake)
list(TRANSFORM folders REPLACE "(.+)" "${SOURCE_DIR}/\\1/*")
file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${SOURCE_DIR} ${folders})
list(FILTER files EXCLUDE REGEX "/node_modules/")
list(APPEND files CMakeLists.txt CMakePresets.json)
list(SORT files)
set(text "${COMPILER}\n${FLAGS}\n")
foreach(file IN LISTS files)
  file(SHA256 ${SOURCE_DIR}/${file} hash)
  string(APPEND text "${file} ${hash}\n")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 16 hash)
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
"#pragma once

#define HEDGEHOP_VERSION \"@VERSION@\"
#define HEDGEHOP_BUILD \"@hash@\"
")
