#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "ensemble/member_batch.h"
#include "io/new_file.h"
#include "scene/member_table.h"

namespace pounding {

/// Contents of ensemble.h5, results apart; alike on every rank.
struct EnsembleLayout {
  const MemberTable* table = nullptr;
  std::vector<std::string> channels;  ///< "probe direction"
  std::vector<double> damping_ratios;
  std::vector<double> frequencies;  ///< [Hz]
  std::vector<std::string> contacts;
  std::vector<double> pair_contacts;  ///< numbers of the contacts of the pairs
  std::vector<double> pair_places;    ///< shape (pairs, 3) [m]
  /// Lines of the sources of the results: a file of other ones is of another ensemble.
  std::vector<std::string> identity;
  std::vector<std::string> spans;
  std::vector<std::string> bases;   ///< structures whose base can move
  bool friction = false;            ///< contacts have slip
  std::vector<std::string> forces;  ///< columns of recorded forces
  std::vector<double> force_times;  ///< of their records [s]
  StruckPlaces struck;
};

/// The file of the results of an ensemble: every member has a place of its own in it, taken when
/// the file is made, which any process may fill at any time. A member's flag `done` is set once its
/// numbers are on the disk, so that a run that was killed is continued with the missing ones. The
/// file is sealed but for these places (file_seal.h), and every member has the CRC-32 of its
/// numbers.
class EnsembleFile {
 public:
  /// Throws UserError if the file is there and is that of other lines of `layout` than its first
  /// ones. Serial.
  static void refuse_another(const std::string& path, const EnsembleLayout& layout);

  /// Makes the file if there is none; else throws UserError unless it is that of `layout`. Serial.
  static void prepare(const std::string& path, const EnsembleLayout& layout);

  /// Opens a prepared file. Throws UserError. Each rank on its own.
  EnsembleFile(const std::string& path, const EnsembleLayout& layout);

  /// Per member, whether it is done and its numbers are those written.
  std::vector<bool> done() const;
  /// Number of members that are said to be done, and whose numbers are not those written.
  std::size_t damaged() const;
  /// Writes a member and sets its flag.
  void write(std::size_t member, const MemberResult& result);
  /// A member that is done.
  MemberResult read(std::size_t member) const;

 private:
  enum class Member { missing, done, damaged };
  std::vector<Member> members() const;
  const EnsembleLayout& layout_;
  OffsetFile reader_;
  OffsetFile writer_;
  std::vector<std::int64_t> offsets_;  ///< per quantity
  std::int64_t done_ = 0;
  std::int64_t sums_ = 0;
};

/// ensemble.csv: a line per member, its options and main numbers. Throws UserError.
void write_ensemble_table(const std::string& path, const EnsembleLayout& layout,
                          const EnsembleFile& file, int digits);

/// Lines of the sources of an ensemble's results: the scene's options but those that leave them as
/// they are, and the table. `resolved`: options in force.
std::vector<std::string> ensemble_identity(const OptionValues& resolved, const MemberTable& table);

/// Lines of the files that scene and table name, and of `opened`, of which the meshes are made: by
/// their content. Rank 0 reads the files, and knows `opened`. Throws UserError. Collective.
std::vector<std::string> identity_of_files(MPI_Comm comm, const OptionValues& resolved,
                                           const MemberTable& table,
                                           const std::vector<std::string>& opened);

}  // namespace pounding
