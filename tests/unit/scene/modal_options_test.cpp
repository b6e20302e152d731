#include "scene_cases.h"

namespace pounding::scene_cases {
namespace modal_options_test {

OptionsDatabase reduced(OptionsDatabase changes) {
  changes.merge(OptionsDatabase{{"tower_model", "modal"}, {"tower_modal_vectors", "40"}});
  return with(smallest(), changes);
}

TEST(ModalOptions, LeftOutAreAFullModel) {
  EXPECT_FALSE(read_scene(smallest()).scene.structures[0].modal);
}

TEST(ModalOptions, HaveDefaults) {
  const auto modal = read_scene(reduced({})).scene.structures[0].modal;
  ASSERT_TRUE(modal);
  EXPECT_EQ(modal->modes, 40);
  EXPECT_EQ(modal->candidates, 0);
  EXPECT_EQ(modal->cutoff, 0);
  EXPECT_TRUE(modal->attachment);
  EXPECT_TRUE(modal->damping_ratios.empty());
  EXPECT_TRUE(modal->basis_file.empty());
}

TEST(ModalOptions, AreRead) {
  const OptionsDatabase database = with(smallest(), {{"tower_model", "modal"},
                                                     {"tower_modal_cutoff", "400"},
                                                     {"tower_modal_attachment", "false"},
                                                     {"tower_modal_damping", "0.01,0.02"},
                                                     {"tower_modal_basis", "tower.h5"}});
  const auto modal = read_scene(database).scene.structures[0].modal;
  ASSERT_TRUE(modal);
  EXPECT_EQ(modal->modes, 0);
  EXPECT_EQ(modal->cutoff, 400);
  EXPECT_FALSE(modal->attachment);
  EXPECT_EQ(modal->damping_ratios, (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(modal->basis_file, "tower.h5");
  const auto chosen = read_scene(reduced({{"tower_modal_candidates", "40"}})).scene.structures[0];
  EXPECT_EQ(chosen.modal->candidates, 40);
}

TEST(ModalOptions, ThatDoNotFitAreRefused) {
  expect_refused(with(smallest(), {{"tower_model", "modal"}}),
                 {"-tower_modal_vectors", "-tower_modal_cutoff"});
  expect_refused(with(smallest(), {{"tower_modal_vectors", "40"}}),
                 {"-tower_modal_vectors 40", "-tower_model modal"});
  expect_refused(with(smallest(), {{"tower_modal_basis", "a.h5"}}), {"-tower_model modal"});
  expect_refused(reduced({{"tower_modal_candidates", "39"}}),
                 {"-tower_modal_candidates 39", "at least as many", "-tower_modal_vectors 40"});
  expect_refused(with(smallest(), {{"tower_modal_candidates", "40"}}),
                 {"-tower_modal_candidates 40", "-tower_model modal"});
  expect_refused(with(smallest(), {{"tower_model", "modal"},
                                   {"tower_modal_cutoff", "400"},
                                   {"tower_modal_candidates", "40"}}),
                 {"-tower_modal_candidates 40", "-tower_modal_vectors"});
  expect_refused(reduced({{"tower_modal_vectors", "0"}}), {"-tower_modal_vectors 0", ">= 1"});
  expect_refused(reduced({{"tower_modal_cutoff", "400"}}),
                 {"-tower_modal_cutoff 400", "-tower_modal_vectors", "not both"});
  expect_refused(reduced({{"tower_modal_damping", "0.01,1"}}), {"-tower_modal_damping", "[0, 1)"});
}

TEST(ModalOptions, RefuseWhatCouplesTheModes) {
  expect_refused(reduced({{"tower_slab_damping_beta", "1e-5"}}),
                 {"-tower_slab_damping_beta", "-tower_model modal"});
  expect_refused(
      reduced({{"tower_slab_damping_ratio", "0.01"}, {"tower_slab_damping_frequencies", "1,10"}}),
      {"-tower_slab_damping_ratio", "-tower_model modal"});
}

TEST(ModalOptions, TakeLinksButSlackBarsBesideUniformDamping) {
  auto links = reduced({{"tower_tie_element", "bar"},
                        {"tower_tie_material", "concrete"},
                        {"tower_tie_area", "1"},
                        {"tower_tie_tension_only", "true"},
                        {"tower_pad_element", "grounded_spring"},
                        {"tower_pad_stiffness", "1,1,1"},
                        {"tower_pad_dashpot", "0,2,0"}});
  EXPECT_TRUE(read_scene(links).scene.structures[0].modal);
  links["tower_damping_uniform"] = "0.02";
  expect_refused(links, {"-tower_tie_tension_only", "-tower_damping_uniform"});
}

TEST(ModalOptions, RefuseOneFileForTwoBases) {
  expect_refused(with(pair(), {{"tower_model", "modal"},
                               {"tower_modal_vectors", "40"},
                               {"tower_modal_basis", "one.h5"},
                               {"annex_model", "modal"},
                               {"annex_modal_vectors", "40"},
                               {"annex_modal_basis", "one.h5"}}),
                 {"-annex_modal_basis one.h5", "tower"});
}

}  // namespace modal_options_test
}  // namespace pounding::scene_cases
