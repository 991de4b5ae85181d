# find_package(Specula): the imported targets Specula::specula (shared) and Specula::specula_static.
#
# Lies in <prefix>/lib/cmake/Specula; the prefix may be moved.

get_filename_component(_specula_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(_specula_include "${_specula_prefix}/include")
set(_specula_shared "${CMAKE_SHARED_LIBRARY_PREFIX}specula_c${CMAKE_SHARED_LIBRARY_SUFFIX}")
set(_specula_static "${CMAKE_STATIC_LIBRARY_PREFIX}specula_c${CMAKE_STATIC_LIBRARY_SUFFIX}")
if(WIN32)
  set(_specula_shared "${_specula_prefix}/bin/${_specula_shared}")
else()
  set(_specula_shared "${_specula_prefix}/lib/${_specula_shared}")
endif()
set(_specula_static "${_specula_prefix}/lib/${_specula_static}")

if(NOT TARGET Specula::specula AND EXISTS "${_specula_shared}")
  add_library(Specula::specula SHARED IMPORTED)
  # It has no soname: without this, programs would have its whole path in them.
  set_target_properties(Specula::specula PROPERTIES
    IMPORTED_LOCATION "${_specula_shared}"
    IMPORTED_IMPLIB "${_specula_prefix}/lib/specula_c.dll.lib"
    IMPORTED_NO_SONAME TRUE
    INTERFACE_INCLUDE_DIRECTORIES "${_specula_include}")
endif()

if(NOT TARGET Specula::specula_static AND EXISTS "${_specula_static}")
  add_library(Specula::specula_static STATIC IMPORTED)
  set_target_properties(Specula::specula_static PROPERTIES
    IMPORTED_LOCATION "${_specula_static}"
    INTERFACE_INCLUDE_DIRECTORIES "${_specula_include}")
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    # What it needs of the system.
    set_target_properties(Specula::specula_static PROPERTIES
      INTERFACE_LINK_LIBRARIES "pthread;dl;m;gcc_s")
  endif()
endif()

if(NOT TARGET Specula::specula AND NOT TARGET Specula::specula_static)
  set(Specula_FOUND FALSE)
  set(Specula_NOT_FOUND_MESSAGE "no library of Specula in ${_specula_prefix}/lib")
endif()
