#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "common/byte_texts.h"
#include "common/standard_streams.h"
#include "spectra/spectra_job.h"
#include "spectra/spectra_options.h"

/// Exit status: 0, or 1 after an error, which is one line.
int main(int count, char** arguments) {
  pounding::guard_standard_streams();
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (std::ranges::any_of(words, [](const std::string& word) {
        return word == "--help" || word == "-help" || word == "-h";
      })) {
    std::fputs(pounding::spectra_help().c_str(), stdout);
    return std::fflush(stdout) == 0 ? 0 : 1;
  }
  try {
    pounding::run_spectra(pounding::read_spectra_options(words));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pounding-spectra: %s\n", pounding::one_line(error.what()).c_str());
  }
  return 1;
}
