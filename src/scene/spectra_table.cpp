#include <array>

#include "scene/option_table.h"

namespace pounding {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr Range whatever{};
constexpr Range above_0{0, endless, true, false};
constexpr Range from_0{0, endless, false, false};
constexpr Range from_1{1, endless, false, false};
constexpr Range below_one{0, 1, false, true};

constexpr Preset preset(std::string_view text) {
  return {true, false, text};
}
constexpr Preset without(std::string_view text) {
  return {false, false, text};
}

// clang-format off
constexpr std::array spectra_rows{
    OptionRow{OptionBlock::spectra, "-channels", OptionKind::names, "names", preset("none"), whatever, "", "history: which channels, as s2_floor2.x, or s2_floor2 for its three directions; none: all"},
    OptionRow{OptionBlock::spectra, "-frame", OptionKind::choice, "word", preset("absolute"), whatever, "absolute|relative", "history: the absolute acceleration, or less that of the ground"},
    OptionRow{OptionBlock::spectra, "-columns", OptionKind::reals, "column", without("left out: the only one beside the time"), from_1, "numbers between commas", "record: which columns, counted from 1"},
    OptionRow{OptionBlock::spectra, "-unit", OptionKind::choice, "word", without("left out: as its header says"), whatever, "g|m/s2|cm/s2|mm/s2", "record: its unit"},
    OptionRow{OptionBlock::spectra, "-time-step", OptionKind::real, "s", without("left out: as the file says"), above_0, "", "record: its time step"},
    OptionRow{OptionBlock::spectra, "-start", OptionKind::real, "s", preset("0"), from_0, "", "begin there, with oscillators at rest; 0: where the samples begin"},
    OptionRow{OptionBlock::spectra, "-damping", OptionKind::reals, "ratio", preset("0.05"), below_one, "numbers between commas", "damping ratios"},
    OptionRow{OptionBlock::spectra, "-frequencies", OptionKind::text, "list", preset("0.5:400:200log"), whatever, "regulatory, START:STOP:COUNTlog, START:STOP:COUNTlin or f1,f2,..., increasing, above 0 [Hz]", "frequencies [Hz]: START:STOP:COUNTlog, ...lin, f1,f2,..., or regulatory: the 75 from 0.2 to 34 Hz of U.S. NRC Regulatory Guide 1.122"},
    OptionRow{OptionBlock::spectra, "-true", OptionKind::boolean, "flag", preset("false"), whatever, "", "also the true peaks: relative velocity, absolute and relative acceleration"},
    OptionRow{OptionBlock::spectra, "-after", OptionKind::choice, "word", preset("auto"), whatever, "auto|free_vibration|ignored", "whether the free vibration after the last sample counts; auto: it does for a record, not for a history, which is cut short"},
    OptionRow{OptionBlock::spectra, "-envelope", OptionKind::boolean, "flag", preset("false"), whatever, "", "the envelope of all channels instead of each"},
    OptionRow{OptionBlock::spectra, "-rotd", OptionKind::reals, "percent", without("left out: each component"), Range{0, 100, false, false}, "numbers between commas", "percentiles over all horizontal directions of a pair of components: 50 (RotD50), 100 (RotD100); of a history x and y of every probe, of records two columns or files"},
    OptionRow{OptionBlock::spectra, "-broaden", OptionKind::real, "percent", preset("0"), Range{0, 100, false, true}, "", "widen every peak by so much to both sides (15 in Regulatory Guide 1.122)"},
    OptionRow{OptionBlock::spectra, "-treatment", OptionKind::text, "names", preset("complete"), whatever, "complete, all_peaks, highest_peak, without_peaks, dirac or all, between commas", "part of a signal with impacts that is kept, one or more of:\n  complete       everything\n  all_peaks      the samples during contacts, zero between them\n  highest_peak   of these the one with the largest impulse\n  without_peaks  everything but the peaks\n  dirac          a triangle of this impulse, its base two time steps\n  all            the five of them\n"},
    OptionRow{OptionBlock::spectra, "-impacts", OptionKind::text, "file", without("left out: the one beside FILE"), whatever, "a file", "when the bodies touch: impacts.csv of the run"},
    OptionRow{OptionBlock::spectra, "-contacts", OptionKind::names, "names", preset("none"), whatever, "", "whose impacts make the peaks; none: all"},
    OptionRow{OptionBlock::spectra, "-margin", OptionKind::real, "s", preset("0"), from_0, "", "time added to a contact on both sides"},
    OptionRow{OptionBlock::spectra, "-dirac-step", OptionKind::real, "s", without("left out: the time step in summary.json beside FILE"), above_0, "", "half the base of the triangle"},
    OptionRow{OptionBlock::spectra, "-output", OptionKind::text, "file", without("left out: standard output"), whatever, "a file", "CSV of the spectra"},
    OptionRow{OptionBlock::spectra, "-peaks", OptionKind::text, "file", without("left out: none"), whatever, "a file", "CSV of the peaks: start, end, impulse of the floor per unit of mass"},
    OptionRow{OptionBlock::spectra, "-digits", OptionKind::integer, "digits", preset("9"), Range{6, 17, false, false}, "", "significant ones of every number; 17: to the bit"},
};
// clang-format on

}  // namespace

std::span<const OptionRow> spectra_option_table() {
  return spectra_rows;
}

}  // namespace pounding
