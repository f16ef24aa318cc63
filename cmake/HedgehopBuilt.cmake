# The first step of `cmake --install`: stops with the command that builds the missing files.
include_guard()

# hedgehop_require_built(<component> <files>): generator expressions may name targets that are added later.
function(hedgehop_require_built component)
  set(files "")
  foreach(file IN LISTS ARGN)
    string(APPEND files " [=[${file}]=]")
  endforeach()
  install(CODE "foreach(file IN ITEMS${files})
  if(NOT EXISTS \"\${file}\")
    message(FATAL_ERROR \"\${file} is not built. Build everything that is installed, then install again: scripts/build hedgehop_package\")
  endif()
endforeach()" COMPONENT ${component})
endfunction()
hedgehop_require_built(program "$<TARGET_FILE:hedgehop>" "${PROJECT_BINARY_DIR}/manual/man/hedgehop.1")
foreach(target IN LISTS HEDGEHOP_PYTHON_TARGETS)
  hedgehop_require_built(python "$<TARGET_FILE:${target}>")
endforeach()
