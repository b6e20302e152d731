#include "mesh/unv_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "common/error.h"
#include "support/refusal.h"

namespace pounding {
namespace unv_file_test {

/// Numbers of ten columns.
std::string line(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) {
    char field[12];
    std::snprintf(field, sizeof field, "%10d", value);
    text += field;
  }
  return text + "\n";
}

std::string dataset(int number, const std::string& content) {
  return "    -1\n" + line({number}) + content + "    -1\n";
}

/// Nodes of a cube and two beyond it, with exponents as Fortran writes them.
std::string nodes() {
  std::string content;
  for (int node = 1; node <= 10; ++node) {
    const int corner = node - 1;
    char field[100];
    std::snprintf(field, sizeof field, "%25.16E%25.16E%25.16E\n", double(corner & 1),
                  double(corner >> 1 & 1), 0.5 * double(corner >> 2));
    std::string text(field);
    std::ranges::replace(text, 'E', 'D');
    content += line({node, 1, 1, 11}) + text;
  }
  return dataset(2411, content);
}

std::string elements() {
  return dataset(2412, line({7, 115, 3, 1, 7, 8}) + line({1, 2, 4, 3, 5, 6, 8, 7}) +
                           line({8, 44, 4, 1, 7, 4}) + line({1, 3, 4, 2}) +
                           line({9, 21, 5, 1, 7, 2}) + line({0, 1, 1}) + line({9, 10}));
}

std::string group(int number, const std::string& name, std::initializer_list<int> pairs) {
  std::string content = line({number, 0, 0, 0, 0, 0, 0, static_cast<int>(pairs.size()) / 2});
  content += name + "\n";
  int placed = 0;
  for (auto each = pairs.begin(); each != pairs.end(); each += 2) {
    std::string entry = line({each[0], each[1], 0, 0});
    if (++placed % 2 == 1 && each + 2 != pairs.end()) entry.pop_back();
    content += entry;
  }
  return content;
}

class UnvFile : public ::testing::Test {
 protected:
  UnvFile() {
    char name[] = "/tmp/pounding-XXXXXX.unv";
    close(mkstemps(name, 4));
    path_ = name;
  }
  ~UnvFile() override { unlink(path_.c_str()); }

  RawMesh read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_unv("-a_mesh a.unv", path_);
  }

  std::string refusal(const std::string& text) {
    return testing_support::refusal_of([&] { read(text); });
  }

  /// Elements of a group in a dimension, by their tags.
  static std::vector<std::int64_t> members(const RawMesh& mesh, const std::string& name,
                                           int dimension) {
    std::vector<std::int64_t> tags;
    for (const RawGroup& group : mesh.groups) {
      if (group.name != name || group.dimension != dimension) continue;
      for (const RawEntity& entity : mesh.entities) {
        const bool in = std::ranges::find(group.entities, entity.tag) != group.entities.end();
        if (!in || entity.dimension != dimension) continue;
        for (const RawElements& each : entity.elements) {
          tags.insert(tags.end(), each.tags.begin(), each.tags.end());
        }
      }
    }
    std::ranges::sort(tags);
    return tags;
  }

  std::string path_;
};

TEST_F(UnvFile, GroupsHaveElementsOfSeveralAndNodes) {
  const std::string groups = group(1, "body", {8, 7}) + group(2, "all of it", {8, 7, 8, 8, 8, 9}) +
                             group(3, "corner", {7, 1, 7, 4});
  const RawMesh mesh = read(nodes() + elements() + dataset(2467, groups) +
                            dataset(2420, line({1, 0, 0}) + "part\n"));
  EXPECT_EQ(mesh.node_tags.size(), 10U);
  EXPECT_EQ(mesh.coordinates[3 * 7], 1);
  EXPECT_EQ(mesh.coordinates[3 * 7 + 2], 0.5);
  using Tags = std::vector<std::int64_t>;
  EXPECT_EQ(members(mesh, "body", 3), Tags{7});
  EXPECT_EQ(members(mesh, "body", 2), Tags{});
  EXPECT_EQ(members(mesh, "all of it", 3), Tags{7});
  EXPECT_EQ(members(mesh, "all of it", 2), Tags{8});
  EXPECT_EQ(members(mesh, "all of it", 1), Tags{9});
  EXPECT_EQ(members(mesh, "corner", 0).size(), 2U);
  for (const RawEntity& entity : mesh.entities) {
    if (entity.dimension != 3) continue;
    EXPECT_EQ(entity.elements[0].type, 5);
    EXPECT_EQ(entity.elements[0].nodes, (Tags{1, 2, 4, 3, 5, 6, 8, 7}));
  }
}

TEST_F(UnvFile, WithoutGroupsPropertiesAreThem) {
  const RawMesh mesh = read(nodes() + elements());
  EXPECT_EQ(members(mesh, "3", 3), std::vector<std::int64_t>{7});
  EXPECT_EQ(members(mesh, "4", 2), std::vector<std::int64_t>{8});
  EXPECT_EQ(members(mesh, "5", 1), std::vector<std::int64_t>{9});
}

TEST_F(UnvFile, WhatIsNotReadIsRefusedWithItsLine) {
  const auto refuses = [&](const std::string& text, const std::string& words) {
    const std::string said = refusal(text);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("-a_mesh a.unv: " + path_ + " line "), std::string::npos) << said;
  };
  refuses("no mesh\n", "no elements");
  refuses(nodes(), "no elements");
  refuses(nodes() + elements() + dataset(2417, ""), "dataset 2417 of groups is not read");
  refuses(dataset(15, ""), "dataset 15 of nodes");
  refuses(elements(), "node 1, which does not come before it");
  refuses(nodes() + nodes(), "node 1 occurs twice");
  refuses(nodes() + elements() + elements(), "element 7 occurs twice");
  refuses(nodes() + elements() + dataset(2467, group(1, "g", {8, 70})), "element 70");
  refuses(nodes() + elements() + dataset(2467, group(1, "g", {7, 70})), "a node that is missing");
  refuses(nodes() + dataset(2412, line({7, 115, 3, 1, 7, -8})), "an element of -8 nodes");
  refuses(nodes() + dataset(2412, "     seven\n"), "'seven' is no whole number");
  const auto millimetres = [](const char* factor) {
    const std::string one = "   1.0000000000000000D+00";
    return dataset(164, line({5}) + "   " + factor + one + one + "\n" + one + "\n");
  };
  refuses(millimetres("1.0000000000000000D+03"), "another unit");
  const std::string whole = nodes() + elements();
  for (std::size_t size = 100; size + 8 < whole.size(); size += 97) {
    EXPECT_NE(refusal(whole.substr(0, size)), "") << size;
  }
}

}  // namespace unv_file_test
}  // namespace pounding
