// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/octree_file.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <ostream>
#include <streambuf>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {
namespace {

constexpr std::int32_t kKeyOffset = 1 << 15;  // octomap's tree_max_val

/// A stream into an AtomicFile. Its InputErrors pass through the stream (exceptions(badbit)).
class FileBuffer : public std::streambuf {
 public:
  explicit FileBuffer(AtomicFile& file) : file_(file) {}
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 protected:
  std::streamsize xsputn(const char* data, std::streamsize count) override {
    file_.write({data, static_cast<std::size_t>(count)});
    bytes_ += count;
    return count;
  }
  int_type overflow(int_type character) override {
    const char byte = traits_type::to_char_type(character);
    xsputn(&byte, 1);
    return character;
  }

 private:
  AtomicFile& file_;
  std::int64_t bytes_ = 0;
};

octomap::OcTreeKey key_of(const OccupancyVoxel& voxel) {
  const auto key = [&](int axis) {
    return static_cast<octomap::key_type>(voxel.position[axis] + kKeyOffset);
  };
  return {key(0), key(1), key(2)};
}

void set_color(octomap::OcTreeNode& /*node*/, const OccupancyVoxel& /*voxel*/) {}

void set_color(octomap::ColorOcTreeNode& node, const OccupancyVoxel& voxel) {
  if (voxel.occupied) node.setColor(voxel.color.r, voxel.color.g, voxel.color.b);
}

template <class Tree>
void set_model(Tree& tree, const OccupancyOptions& options) {
  tree.setProbHit(options.hit);
  tree.setProbMiss(options.miss);
  tree.setClampingThresMin(options.clamp_min);
  tree.setClampingThresMax(options.clamp_max);
  tree.setOccupancyThres(options.threshold);
}

template <class Tree>
void fill(Tree& tree, const OccupancyGrid& grid) {
  constexpr bool kLazy = true;
  set_model(tree, grid.options());
  grid.visit_sorted([&](const OccupancyVoxel& voxel) {
    set_color(*tree.setNodeValue(key_of(voxel), voxel.log_odds, kLazy), voxel);
  });
  tree.updateInnerOccupancy();
  tree.prune();
}

/// What octomap's writeBinary does, which prints to stderr as well.
void write_binary(octomap::OcTree& tree, std::ostream& stream) {
  tree.toMaxLikelihood();
  tree.prune();
  stream << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line "
            "as it is!)\n"
         << "#\nid OcTree\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  if (tree.getRoot() != nullptr) tree.writeBinaryNode(stream, tree.getRoot());
}

template <class Tree, class Write>
OctreeFileReport write_tree(const std::filesystem::path& path, const OccupancyGrid& grid,
                            const Write& write) {
  Tree tree(grid.options().resolution);
  fill(tree, grid);
  AtomicFile file(path);
  FileBuffer buffer(file);
  std::ostream stream(&buffer);
  stream.exceptions(std::ios::badbit);
  write(tree, stream);
  file.commit();
  return {static_cast<std::int64_t>(tree.size()), buffer.bytes()};
}

}  // namespace

std::string_view to_string(OctreeContents contents) {
  switch (contents) {
    case OctreeContents::binary:
      return "occupied and free";
    case OctreeContents::color:
      return "probabilities and colours";
    case OctreeContents::plain:
      break;
  }
  return "probabilities";
}

OctreeContents octree_contents(const std::filesystem::path& path, bool colored) {
  if (path.extension() == ".bt") return OctreeContents::binary;
  if (path.extension() == ".ot") return colored ? OctreeContents::color : OctreeContents::plain;
  throw InputError({path.string(), 0, "a file name that ends in .bt or .ot",
                    path.has_extension() ? "'" + path.extension().string() + "'" : "no extension",
                    ".bt keeps occupied and free only, .ot probabilities and colour as well."});
}

OctreeFileReport write_octree(const std::filesystem::path& path, const OccupancyGrid& grid,
                              OctreeContents contents) {
  const auto write_all = [](auto& tree, std::ostream& stream) { tree.write(stream); };
  switch (contents) {
    case OctreeContents::binary:
      return write_tree<octomap::OcTree>(path, grid, write_binary);
    case OctreeContents::color:
      return write_tree<octomap::ColorOcTree>(path, grid, write_all);
    case OctreeContents::plain:
      break;
  }
  return write_tree<octomap::OcTree>(path, grid, write_all);
}

}  // namespace cairn
