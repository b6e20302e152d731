#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/new_file.h"
#include "observers/field_plan.h"
#include "observers/observed_run.h"
#include "output/file_blocks.h"
#include "output/mesh_grid.h"
#include "system/trace.h"

namespace pounding {

/// Writes `fields.h5`, the motion of all nodes, and for ParaView `fields.xdmf`, `fields.vtkhdf` or
/// both. Per structure, beside the datasets of write_mesh() and, for the latter, of
/// write_vtk_cells(), groups with an array 000000 ... of shape (nodes, 3) for each frame, nodes in
/// file order:
///
///     displacement      u_n, of t_n in `time`, relative to the ground [m]
///     velocity          v_{n+1/2}, half a step later, relative to the ground [m/s]
///     rotation          of t_n, where nodes rotate and the structure is not reduced [rad]
///     contact_impulse   that contacts brought to the node since the frame before [N s]
///
/// and, where elements yield, arrays of shape (cells), of t_n:
///
///     ductility         the largest of the laws of an element so far
///     damage            of shells that crack, d / (1 + d) of the worse face
///     lost_energy       by the element so far [J]
///
/// the first two to the bit as in the history of the same node. The arrays take their places in the
/// file at the beginning; then every rank fills its part of them (FileBlocks) as the run goes.
/// `frames` is the number of whole frames, written after them, and `fields.xdmf` and
/// `fields.vtkhdf`, whole files at any moment, list these; places behind are no motion. A frame
/// allocates nothing but the line of the list.
class FieldWriter final : public Observer {
 public:
  /// Creates the files, unless the run is a continued one. Throws UserError on every rank alike (no
  /// space). Collective.
  explicit FieldWriter(const ObservedRun& run);

  /// Takes the frames over that `continued` knows from the file continued, which may be the one
  /// that is then replaced. Throws UserError on every rank alike. Collective.
  void start(const CdLagrange& stepper, const SavedState* continued) override;
  std::int64_t next_due(std::int64_t step) const override;
  StepNeeds begin(const CdLagrange& stepper) override;
  /// Writes the frame. Throws UserError on every rank alike (no space). Collective.
  void observe(const CdLagrange& stepper) override;
  /// Adds the impulses of contacts up.
  bool follows() const override { return !impulses_.empty(); }
  void follow(const CdLagrange& stepper) override;
  /// Lists the frames that are there. Collective.
  void flush() override;
  /// Lists them, everything on the disk. Collective.
  void finish(bool complete) override;
  /// Keeps the number of frames and the impulses since the last one, and lists the frames.
  /// Brought back, it refuses a file that cannot be continued.
  void keep_state(const StateKeeper& state) override;

 private:
  /// A quantity of a structure.
  struct Quantity {
    std::string name;
    const char* unit;
    std::vector<double> owned;            ///< shape (owned_nodes, 3); of cells empty
    std::vector<std::int64_t> offsets{};  ///< of its arrays in the file, per frame [bytes]
    bool of_cells = false;
  };
  struct StructureFields {
    std::string name;
    std::size_t nodes = 0;  ///< of all ranks
    std::size_t cells = 0;  ///< of all ranks
    Trace displacement;
    std::optional<Trace> rotation;
    FileBlocks blocks;
    std::vector<double> block;  ///< values of this rank's block
    std::vector<Quantity> quantities;
    std::vector<std::array<std::size_t, 2>> contact;  ///< value of the impulse, place in impulses
    /// Rank 0: place of each cell by its region and its number in the mesh file.
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> cell_places{};

    std::vector<std::size_t> shape_of(const Quantity& quantity) const {
      if (quantity.of_cells) return {cells};
      return {nodes, 3};
    }
  };

  StructureFields fields_of(std::size_t structure);
  void create(const std::string& path);
  /// Takes the places of all arrays of a file. Rank 0.
  std::vector<std::int64_t> reserve(Hdf5File& file) const;
  /// Name of an array in the file.
  static std::string path_of(const StructureFields& fields, const Quantity& quantity,
                             std::int64_t frame);
  void write_cells(std::size_t structure);
  void open();
  void copy_frames(const std::string& to) const;
  std::string frame_text(std::int64_t frame) const;
  /// Writes `fields.vtkhdf` of the frames so far. Rank 0.
  void list_for_vtk() const;
  double time_of(std::int64_t frame) const;

  ObservedRun run_;
  FieldSteps steps_;
  std::string continued_;  ///< fields.h5 of the run that this one continues; empty: a new one
  bool xdmf_;              ///< whether fields.xdmf lists the frames
  bool vtkhdf_;            ///< whether fields.vtkhdf does
  MeshLabels labels_;
  std::vector<char> yields_;  ///< per structure, whether elements of it may
  std::vector<StructureFields> structures_;
  std::vector<double> impulses_;
  std::unique_ptr<OffsetFile> file_;
  std::int64_t frames_ = 0;

  // Rank 0
  std::vector<XdmfGrid> grids_;          ///< of the structures, without motions
  std::vector<std::size_t> cell_nodes_;  ///< of all cells of each structure together
  std::int64_t frames_offset_ = 0;       ///< of their number in the file [bytes]
  std::string text_;                     ///< of the frames so far
};

}  // namespace pounding
