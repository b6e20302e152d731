#pragma once

#include "io/hdf5_file.h"
#include "io/hdf5_reader.h"

/// Numbers of the layouts of files that outlive a run. A number rises when a reader of the one
/// before would misread the file: another meaning of a name counts, a name more does not. Files of
/// the versions before these numbers have none, or a `version` in its place.
namespace pounding::schema {

inline constexpr int summary = 1;      ///< summary.json
inline constexpr int history = 1;      ///< history.h5
inline constexpr int fields = 1;       ///< fields.h5
inline constexpr int modes = 1;        ///< modes.h5
inline constexpr int model = 1;        ///< model.h5
inline constexpr int ensemble = 1;     ///< ensemble.h5
inline constexpr int basis = 4;        ///< of a reduced structure
inline constexpr int checkpoint = 15;  ///< checkpoint.h5

/// Attributes of the file: `schema` and the `program` that wrote it.
void write(Hdf5File& file, int number);

/// Throws std::runtime_error unless the file has this schema: "of schema 3, written by pounding
/// 0.1.0; this program reads schema 4".
void require(const Hdf5Reader& file, int number);

}  // namespace pounding::schema
