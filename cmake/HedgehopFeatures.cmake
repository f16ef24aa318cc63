# What Hedgehop can be built without. A source then gives way to `<name>_absent.cpp`, which says what is missing when it is
# asked for; `hedgehop --version --features` and the configure step list them.
include_guard()

# hedgehop_feature(<found> <name> <Debian packages> [<variable> <sources> <sources in their place>]): sets the variable to
# one of them.
function(hedgehop_feature found name packages)
  if(found)
    set(row "yes  ${name}")
  else()
    set(row "no   ${name}: install ${packages}, and build Hedgehop again")
    message(STATUS "without ${name}: it takes ${packages}")
  endif()
  set_property(GLOBAL APPEND PROPERTY HEDGEHOP_FEATURES "${row}")
  if(ARGC GREATER 3)
    if(found)
      set(${ARGV3} ${ARGV4} PARENT_SCOPE)
    else()
      set(${ARGV3} ${ARGV5} PARENT_SCOPE)
    endif()
  endif()
endfunction()
