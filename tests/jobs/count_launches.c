/* Loaded before other libraries into what tests start (LD_PRELOAD): notes every true launch of `pounding`, once for all of
   its ranks, as a line with the test's name in the file that POUNDING_LAUNCHES names. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

__attribute__((constructor)) static void note_launch(void) {
  const char* const file = getenv("POUNDING_LAUNCHES");
  const char* const rank = getenv("OMPI_COMM_WORLD_RANK");
  const char* const test = getenv("POUNDING_TEST");
  if (file == NULL || strcmp(program_invocation_short_name, "pounding") != 0) return;
  if (rank != NULL && strcmp(rank, "0") != 0) return;
  char line[256];
  const int length = snprintf(line, sizeof line, "%s\n", test != NULL ? test : "?");
  const int descriptor = open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0 || length < 0) return;
  if (write(descriptor, line, (size_t)length) < 0) perror(file);
  close(descriptor);
}
