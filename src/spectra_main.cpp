#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "common/byte_texts.h"
#include "common/standard_streams.h"
#include "spectra/acceptance.h"
#include "spectra/spectra_job.h"
#include "spectra/spectra_options.h"

/// Exit status: 0, or 1 after an error, which is one line; 3 for motions that a rule refuses.
int main(int count, char** arguments) {
  pounding::guard_standard_streams();
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (std::ranges::any_of(words, [](const std::string& word) {
        return word == "--help" || word == "-help" || word == "-h";
      })) {
    const bool written = std::fputs(pounding::spectra_help().c_str(), stdout) >= 0;
    return std::fflush(stdout) == 0 && written ? 0 : 1;
  }
  try {
    const pounding::SpectraOptions options = pounding::read_spectra_options(words);
    if (!options.rules.empty()) pounding::judge_motions(words);
    pounding::run_spectra(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pounding-spectra: %s\n", pounding::one_line(error.what()).c_str());
  }
  return 1;
}
