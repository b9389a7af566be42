#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>

#include "assets/canvas.h"
#include "assets/meshes.h"
#include "assets/work.h"
#include "files/file.h"
#include "support/environment.h"
#include "support/folder.h"

namespace mimicry {
namespace {

std::string message_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Meshes, ShapesFilesAndFoldersOfShapes) {
  const NamedMesh torus = load_mesh("shape:torus:24");
  EXPECT_EQ(torus.name, "torus");
  EXPECT_NE(message_of([] { load_mesh("shape:torus:x"); }).find("shape:torus:48"),
            std::string::npos);
  EXPECT_EQ(mesh_spec("", "torus"), "shape:torus");

  const test::TestFolder folder;
  write_file_atomically(folder.path("plate.obj"),
                        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 3 2 1\n");
  const std::string file = folder.path("plate.obj");
  EXPECT_EQ(mesh_spec(folder.path(""), "plate"), file);
  EXPECT_EQ(mesh_spec(folder.path(""), "plate.obj"), file);
  EXPECT_NE(message_of([&] { find_mesh_file(folder.path(""), "cube"); }).find("no mesh cube.obj"),
            std::string::npos);
  // What was mended is told to whom asked, with the mesh's name.
  std::vector<std::string> notes;
  Monitor monitor;
  monitor.note = [&](const std::string& note) { notes.push_back(note); };
  const Target target = make_target(load_mesh(file, monitor), {}, monitor);
  EXPECT_EQ(target.mesh().face_count(), 3);
  ASSERT_FALSE(notes.empty());
  EXPECT_TRUE(notes[0].starts_with("plate.obj: ")) << notes[0];
  EXPECT_EQ(make_target(load_mesh(file)).mesh().face_count(), 3);
}

TEST(Bakes, AreKeptAndFoundAgainAndCanBeCancelled) {
  const test::TestFolder folder;
  test::TestVariable cache("MIMICRY_CACHE", folder.path("cache"));
  const TriangleMesh mesh = load_mesh("shape:torus:12").mesh;
  BakeSettings settings;
  settings.options.samples = 40;
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  try {
    bake_mesh(mesh, settings, monitor);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("cache")));

  std::vector<std::string> works, notes;
  monitor.cancelled = nullptr;
  monitor.note = [&](const std::string& note) { notes.push_back(note); };
  monitor.progress = [&](std::string_view work, double fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
    works.emplace_back(work);
  };
  const Baked first = bake_mesh(mesh, settings, monitor);
  EXPECT_FALSE(first.was_kept);
  ASSERT_FALSE(works.empty());
  EXPECT_EQ(works[0], "baking");
  const Baked second = bake_mesh(mesh, settings);
  EXPECT_TRUE(second.was_kept);
  EXPECT_EQ(second.embedding.mesh_hash, first.embedding.mesh_hash);
  settings.use_cache = false;
  EXPECT_FALSE(bake_mesh(mesh, settings).was_kept);

  // A bake that cannot be kept is told of, and is there all the same.
  write_file_atomically(folder.path("file"), "");
  cache.set(folder.path("file/cache"));
  settings.use_cache = true;
  EXPECT_TRUE(notes.empty());
  EXPECT_FALSE(bake_mesh(mesh, settings, monitor).was_kept);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("not kept"), std::string::npos);
}

TEST(Techniques, AreChosenInTheRegistrysOrder) {
  const auto chosen = chosen_techniques({"snap", "occlude", "snap"});
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0]->name, "occlude");
  EXPECT_EQ(chosen_techniques({}).size(), techniques().size());
  EXPECT_EQ(chosen_techniques({"snap", "all"}).size(), techniques().size());
  EXPECT_THROW(chosen_techniques({"nope"}), Error);
}

TEST(Monitors, MayBeEmptyAndEndTheWork) {
  const Monitor none;
  none.tell("unheard");
  none.report("work", 1, 2);
  Monitor monitor;
  double last = 0;
  monitor.progress = [&](std::string_view, double fraction) { last = fraction; };
  monitor.report("work", 1, 4);
  EXPECT_EQ(last, 0.25);
  monitor.report("work", 3, 0);
  EXPECT_EQ(last, 0.25) << "of an unknown total nothing is told";
  monitor.report("work", 5, 4);
  EXPECT_EQ(last, 1.0) << "a file that grows";
  monitor.cancelled = [] { return true; };
  EXPECT_THROW(monitor.check(), Error);
  EXPECT_THROW(monitor.report("work", 1, 4), Error);
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
}

}  // namespace
}  // namespace mimicry
