# Optional features. Without its packages, a feature is built from `<name>_absent.cpp`, which reports the missing package
# when the feature is used. `hedgehop --version --features` and the configure step list all features.
include_guard()

# hedgehop_feature(<found> <name> <Debian packages> [<variable> <sources> <substitute sources>]): sets the variable to the
# sources, or to the substitutes if the feature was not found.
function(hedgehop_feature found name packages)
  if(found)
    set(row "yes  ${name}")
  else()
    set(row "no   ${name}: install ${packages} and rebuild Hedgehop")
    message(STATUS "without ${name}: install ${packages} to enable this feature")
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
