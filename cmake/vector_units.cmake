# Kernels: what takes the time of a step, compiled once for each vector unit and joined in one program, which chooses at
# its start (src/common/vector_unit.h). Everything else is compiled for the first unit.
# docs/manual/install.md has the words.
include(${CMAKE_CURRENT_LIST_DIR}/best_unit.cmake)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(units v2 v3 v4)
  set(POUNDING_BASE -march=x86-64-v2)
  find_best_unit(best)
else()
  set(units generic)
  set(best generic)
  set(POUNDING_BASE)
endif()
set(POUNDING_VECTOR_UNITS ${best} CACHE STRING
  "Vector units that kernels are compiled for: v2 (SSE4.2), v3 (AVX2 and FMA), v4 (AVX-512), or all of them")
if(POUNDING_VECTOR_UNITS STREQUAL all)
  set_property(CACHE POUNDING_VECTOR_UNITS PROPERTY VALUE ${units})
endif()
list(SORT POUNDING_VECTOR_UNITS)  # the least first
if(POUNDING_SANITIZE)  # checked once
  list(GET POUNDING_VECTOR_UNITS 0 POUNDING_VECTOR_UNITS)
endif()

# Every file that uses lanes, and what is called in every step: rooms as a whole, or files.
set(POUNDING_KERNEL_FILES
  "^dynamics/"
  "^stiffness/(bricks/brick_(kernel|lines|stencil)|shells/|strains/|rows/chain_line)"
  "^stiffness/(assembled_rows|batch_stiffness|beam_elements|element_sorter|element_stiffness|single_stiffness|stiffness|strain_sorter)[.]"
  "^interactions/[a-z_]+[.]"
  "^common/row_products[.]"
  "^ensemble/member_batch"
  "^motion/oscillator"
  "^observers/recorder"
  "^solvers/"
  "^system/(block_factorisation|coupled_mass|rigid_body|trace)")

# Moves the kernels of a list of sources to another one.
function(split_kernels sources kernels)
  set(found)
  foreach(source ${${sources}})
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_SOURCE_DIR}/src OUTPUT_VARIABLE place)
    foreach(pattern ${POUNDING_KERNEL_FILES})
      if(place MATCHES "${pattern}")
        list(APPEND found ${source})
      endif()
    endforeach()
  endforeach()
  list(REMOVE_ITEM ${sources} ${found})
  set(${sources} ${${sources}} PARENT_SCOPE)
  set(${kernels} ${found} PARENT_SCOPE)
endfunction()

# The flags of g++ for a unit.
function(flag_of_unit unit flag)
  set(known generic v2 v3 v4)
  if(NOT unit IN_LIST known)
    message(FATAL_ERROR "POUNDING_VECTOR_UNITS: ${unit} is none of ${known}")
  endif()
  if(unit STREQUAL generic)
    set(${flag} "" PARENT_SCOPE)
  else()  # in the order that suits no processor in particular, a step of shells takes a tenth longer
    set(${flag} -march=x86-64-${unit} -mtune=znver3 PARENT_SCOPE)
  endif()
endfunction()

# A program or test with the library and its kernels.
function(link_core target)
  target_link_libraries(${target} PRIVATE pounding_core)
  if(TARGET joined_kernels)
    add_dependencies(${target} joined_kernels)
  endif()
endfunction()

# Adds the kernels of every unit to a library. Of one unit alone they are linked as they are.
function(link_kernels library)
  set(lists)
  set(named)
  set(objects)
  foreach(unit ${POUNDING_VECTOR_UNITS})
    flag_of_unit(${unit} flag)
    add_library(kernels_${unit} OBJECT ${POUNDING_KERNELS})
    compile_rooms_as_one(kernels_${unit})
    target_link_libraries(kernels_${unit} PUBLIC pounding_settings)
    # Unique symbols, of constants in classes, would stay one for all units.
    target_compile_options(kernels_${unit} PRIVATE ${flag} -fno-gnu-unique ${POUNDING_WARNINGS})
    target_compile_definitions(kernels_${unit} PRIVATE POUNDING_KERNELS)
    set(list ${CMAKE_BINARY_DIR}/kernels/${unit}.txt)
    file(GENERATE OUTPUT ${list} CONTENT "$<JOIN:$<TARGET_OBJECTS:kernels_${unit}>,\n>\n")
    list(APPEND lists ${list})
    list(APPEND named ${unit}=${list})
    list(APPEND objects $<TARGET_OBJECTS:kernels_${unit}>)
  endforeach()
  list(JOIN POUNDING_VECTOR_UNITS "\", \"" names)
  set(words "POUNDING_UNITS=\"${names}\"")
  list(LENGTH POUNDING_VECTOR_UNITS count)
  if(count EQUAL 1)
    target_sources(${library} PRIVATE ${objects})
  else()
    set(joined ${CMAKE_BINARY_DIR}/kernels/joined.o)
    add_custom_command(OUTPUT ${joined} COMMAND ${CMAKE_SOURCE_DIR}/cmake/join_units.py ${joined} ${named}
      DEPENDS ${objects} ${lists} ${CMAKE_SOURCE_DIR}/cmake/join_units.py VERBATIM COMMAND_EXPAND_LISTS)
    # Linked beside the library: as a source of it every other source would wait for the kernels.
    add_custom_target(joined_kernels DEPENDS ${joined})
    target_link_libraries(${library} INTERFACE ${joined})
    list(APPEND words POUNDING_JOINED_UNITS)
  endif()
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/common/vector_unit.cpp PROPERTIES
    COMPILE_DEFINITIONS "${words}" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
