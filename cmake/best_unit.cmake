# The best vector unit of this machine, by a program of a few lines that asks the processor. Where it does not run, as when
# another machine is compiled for, the least.
function(find_best_unit best)
  if(NOT DEFINED CACHE{POUNDING_BEST_UNIT})
    set(source ${CMAKE_BINARY_DIR}/best_unit.c)
    file(WRITE ${source} [[
#include <stdio.h>
int main(void) {
  __builtin_cpu_init();
  puts(__builtin_cpu_supports("x86-64-v4") ? "v4" : __builtin_cpu_supports("x86-64-v3") ? "v3" : "v2");
  return 0;
}
]])
    set(found v2)
    if(NOT CMAKE_CROSSCOMPILING)
      try_run(POUNDING_ASKED POUNDING_ASKS ${CMAKE_BINARY_DIR} ${source} RUN_OUTPUT_VARIABLE answer)
      if(POUNDING_ASKS AND "${POUNDING_ASKED}" EQUAL 0)
        string(STRIP "${answer}" found)
      endif()
    endif()
    set(POUNDING_BEST_UNIT ${found} CACHE INTERNAL "The best vector unit of the machine that configured")
  endif()
  set(${best} ${POUNDING_BEST_UNIT} PARENT_SCOPE)
endfunction()
