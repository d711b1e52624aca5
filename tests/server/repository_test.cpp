// SPDX-License-Identifier: Apache-2.0
// Load, verify, swap; and tables within a budget.
#include "repository/repository.h"
#include "repository/table_cache.h"
#include "server/daemon_fixture.h"
#include "shared/content_hash.h"
#include "shared/material_name.h"
#include "support/expect_error.h"

#include <sys/stat.h>

#include <thread>

namespace {

using namespace brdf;
using namespace brdf::service;
namespace fs = std::filesystem;

struct Folder {
  Folder() { fs::create_directory(root); }
  void put(const std::string& id, std::span<const std::byte> bytes) { test::put_file(root / (id + ".brdfc"), bytes); }
  test::TemporaryFolder outer;
  fs::path root = outer / "materials";
};

TEST(MaterialName, OnlyNamesAndNoPaths) {
  EXPECT_EQ(parse_material_name("materials/gold-2.1_x")->id, "gold-2.1_x");
  const std::string version(32, 'a');
  EXPECT_EQ(parse_material_name("materials/gold/versions/" + version)->version, version);
  for (const std::string bad : {"", "gold", "materials/", "materials/..", "materials/../gold", "materials/.hidden", "materials/a/b", "materials//gold", "materials/a\\b", "/materials/gold",
                                "materials/gold/versions/", "materials/gold/versions/12", "materials/gold/versions/../x", "materials/g\xc3\xb6ld", "materials/gold\n"})
    EXPECT_FALSE(parse_material_name(bad)) << bad;
  EXPECT_FALSE(parse_material_name(std::string("materials/a\0b", 13)));
  EXPECT_FALSE(is_material_id(std::string(129, 'a')));
  EXPECT_TRUE(is_material_id(std::string(128, 'a')));
}

TEST(Repository, ReadsWhatIsThereAndSwapsWhatChanges) {
  Folder f;
  f.put("a", test::golden("rgb-lobes"));
  f.put("b", test::golden("rgb-slices"));
  test::put_text(f.root / "notes.txt", "no material");
  Repository r(f.root, RepositoryMode::poll, {});
  PollResult p = r.poll();
  EXPECT_EQ(p.materials, 2U);
  EXPECT_EQ(p.added, 2U);
  const CatalogueHandle before = r.catalogue();
  const VersionHandle a = before->find("a");
  EXPECT_EQ(a->version, version_of(test::golden("rgb-lobes")));

  f.put("a", test::golden("rgb-coded-lobes"));
  f.put("c", test::golden("scalar-one-way"));
  fs::remove(f.root / "b.brdfc");
  p = r.poll();
  EXPECT_EQ(p.added, 1U);
  EXPECT_EQ(p.replaced, 1U);
  EXPECT_EQ(p.removed, 1U);
  EXPECT_EQ(r.catalogue()->find("a")->version, version_of(test::golden("rgb-coded-lobes")));
  EXPECT_EQ(r.catalogue()->find("b"), nullptr);
  // Whoever took the old catalogue keeps it as it was.
  EXPECT_EQ(before->find("a"), a);
  EXPECT_NE(before->find("b"), nullptr);
  const CatalogueHandle same = r.catalogue();
  EXPECT_EQ(r.poll().replaced, 0U);
  EXPECT_EQ(r.catalogue(), same) << "nothing changed, yet the catalogue was swapped";
}

TEST(Repository, ABrokenNewVersionLeavesTheOldOneServing) {
  Folder f;
  f.put("a", test::golden("rgb-slices"));
  Repository r(f.root, RepositoryMode::poll, {});
  r.poll();
  const VersionHandle old = r.catalogue()->find("a");
  const auto& good = test::golden("rgb-reciprocal-layers");
  std::vector<std::vector<std::byte>> broken{{}, {good.begin(), good.begin() + 20}, good};
  broken.back()[good.size() / 2] ^= std::byte{1};
  for (const auto& bytes : broken) {
    f.put("a", bytes);
    const PollResult p = r.poll();
    ASSERT_EQ(p.refused.size(), 1U);
    EXPECT_EQ(p.refused.front().id, "a");
    EXPECT_EQ(r.catalogue()->find("a"), old);
    EXPECT_EQ(r.poll().refused.size(), 1U) << "a refusal is remembered";
  }
  f.put("a", good);
  EXPECT_TRUE(r.poll().refused.empty());
  EXPECT_EQ(r.catalogue()->find("a")->version, version_of(good));
}

TEST(Repository, LinksStayInside) {
  Folder f;
  test::put_file(f.outer / "outside.brdfc", test::golden("rgb-lobes"));
  f.put("inside", test::golden("rgb-lobes"));
  fs::create_symlink("inside.brdfc", f.root / "good.brdfc");
  fs::create_symlink("../outside.brdfc", f.root / "bad.brdfc");
  fs::create_symlink(f.outer / "outside.brdfc", f.root / "absolute.brdfc");
  fs::create_directory(f.root / "folder.brdfc");
  ASSERT_EQ(::mkfifo((f.root / "pipe.brdfc").c_str(), 0600), 0);
  Repository r(f.root, RepositoryMode::poll, {});
  const PollResult p = r.poll();
  EXPECT_EQ(p.materials, 2U);
  EXPECT_NE(r.catalogue()->find("good"), nullptr);
  EXPECT_EQ(r.catalogue()->find("bad"), nullptr);
  EXPECT_EQ(p.refused.size(), 2U);
  const RepositoryFolder folder(f.root);
  for (const char* id : {"../outside", "/etc/passwd", "..", "."}) test::expect_error(ErrorCode::invalid_argument, {"no name"}, [&] { folder.read(id, 1000); });
  test::expect_error(ErrorCode::io, {"link"}, [&] { folder.write("bad", test::golden("rgb-lobes"), true); });
}

TEST(Repository, ExplicitLoadsWhatItIsTold) {
  Folder f;
  f.put("a", test::golden("rgb-lobes"));
  f.put("b", test::golden("rgb-slices"));
  Repository r(f.root, RepositoryMode::manual, {});
  EXPECT_EQ(r.poll().materials, 0U);
  EXPECT_EQ(r.load("a")->id, "a");
  EXPECT_EQ(r.catalogue()->materials().size(), 1U);
  test::expect_error(ErrorCode::io, {"missing"}, [&] { r.load("missing"); });
  f.put("a", test::golden("rgb-coded-lobes"));
  EXPECT_EQ(r.poll().replaced, 1U) << "what is loaded is looked at";
  EXPECT_TRUE(r.unload("a"));
  EXPECT_FALSE(r.unload("a"));
  EXPECT_EQ(r.poll().materials, 0U);
  Repository poll(f.root, RepositoryMode::poll, {});
  test::expect_error(ErrorCode::invalid_argument, {"explicit"}, [&] { poll.load("a"); });
}

TEST(Repository, PublishesWholeFilesAndReplacesOnlyWhenAsked) {
  Folder f;
  Repository r(f.root, RepositoryMode::none, {});
  const auto& bytes = test::golden("rgb-slices");
  EXPECT_EQ(r.publish("new", bytes, false)->version, version_of(bytes));
  EXPECT_TRUE(fs::exists(f.root / "new.brdfc"));
  test::expect_error(ErrorCode::io, {"new"}, [&] { r.publish("new", test::golden("rgb-lobes"), false); });
  EXPECT_EQ(r.catalogue()->find("new")->version, version_of(bytes));
  r.publish("new", test::golden("rgb-lobes"), true);
  EXPECT_EQ(r.catalogue()->find("new")->version, version_of(test::golden("rgb-lobes")));
  EXPECT_THROW(r.publish("bad", {bytes.begin(), bytes.begin() + 30}, true), Error);
  EXPECT_FALSE(fs::exists(f.root / "bad.brdfc"));
}

TEST(Repository, LimitOfMaterials) {
  Folder f;
  for (const char* id : {"a", "b", "c"}) f.put(id, test::golden("rgb-lobes"));
  Repository r(f.root, RepositoryMode::poll, {2, {}});
  const PollResult p = r.poll();
  EXPECT_EQ(p.materials, 2U);
  ASSERT_EQ(p.refused.size(), 1U);
  EXPECT_EQ(p.refused.front().id, "c");
}

TEST(TableCache, KeepsToItsBudgetAndDropsTheOldest) {
  const VersionHandle a = verify_version("a", test::golden("rgb-slices")), b = verify_version("b", test::golden("rgb-reciprocal-layers"));
  const auto whole = [](const VersionHandle& v) { return v->bytes.size(); };
  TableCache roomy(std::uint64_t{1} << 30);
  roomy.get(a, EvalLevel::balanced, whole(a), true);
  const std::uint64_t one = roomy.bytes();
  ASSERT_GT(one, 0U);
  roomy.get(a, EvalLevel::balanced, whole(a), true);
  EXPECT_EQ(roomy.built(), 1U);
  roomy.get(b, EvalLevel::balanced, whole(b), true);
  const std::uint64_t other = roomy.bytes() - one;

  TableCache tight(std::max(one, other));
  for (int i = 0; i < 3; ++i) {
    const Material held = tight.get(a, EvalLevel::balanced, whole(a), true);
    tight.get(b, EvalLevel::balanced, whole(b), true);
    EXPECT_LE(tight.bytes(), tight.budget());
    float f[3];
    held.eval({0, 0, 1}, {0, 0, 1}, f);  // dropped from the cache, alive here
    EXPECT_GT(f[0], 0);
  }
  EXPECT_EQ(tight.built(), 6U);
  EXPECT_EQ(tight.dropped(), 5U);
}

TEST(TableCache, OneOfManyThreadsBuilds) {
  const VersionHandle a = verify_version("a", test::golden("rgb-reciprocal-layers"));
  TableCache cache(std::uint64_t{1} << 30);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) cache.get(a, static_cast<EvalLevel>(i % 3), a->bytes.size(), false);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(cache.built(), 3U);
}

TEST(TableCache, PrefixesAreTheirOwnMaterials) {
  const VersionHandle a = verify_version("a", test::golden("rgb-reciprocal-layers"));
  ASSERT_GT(a->boundaries.size(), 1U);
  TableCache cache(std::uint64_t{1} << 30);
  EXPECT_EQ(cache.get(a, EvalLevel::balanced, a->boundaries[0], false).info().refinements_read, 0);
  EXPECT_EQ(cache.get(a, EvalLevel::balanced, a->bytes.size(), false).info().refinements_read, a->info.refinements_total);
  EXPECT_EQ(a->cut_at(a->boundaries[0]), a->boundaries[0]);
  EXPECT_EQ(a->refinements_in(a->boundaries[0]), 0);
  EXPECT_EQ(a->cut_at(0), a->bytes.size());
  EXPECT_EQ(a->refinements_in(a->bytes.size()), a->info.refinements_total);
  test::expect_error(ErrorCode::invalid_argument, {"prefix_bytes"}, [&] { a->cut_at(a->boundaries[0] + 1); });
}

}  // namespace
