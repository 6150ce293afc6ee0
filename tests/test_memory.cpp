// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
// What a map says of its memory, against what the allocator gave.
#include <akimap/AkiMap.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include "run_program.h"
#include "sanitized.h"
#include "simulation/simulate.h"

using namespace akimap;

namespace {

/** Bytes that this process holds from the allocator, with its own overhead. */
double allocated() {
    const auto all = mallinfo2();
    return static_cast<double>(all.uordblks + all.hblkhd);
}

struct Memory {
    double said, given;  ///< [bytes] by the map, and by the allocator
    std::size_t cells;
};

/** Of a map of one drive of 12 scans. */
Memory memoryOfDrive(app::SceneKind kind, Estimator estimator) {
    app::SimulationOptions drive;
    drive.scene = kind;
    AkiMap map(0.05);
    map.insertionOptions.threads = 1;
    map.insertionOptions.estimator = estimator;
    for (const auto& scan : app::simulatedRays(drive)) map.insertRays(scan);
    Memory m{static_cast<double>(map.memoryBytes()), allocated(), map.cellCount()};
    map.clear();  // keeps the buffers between scans, which are no part of the map
    m.given -= allocated();
    return m;
}

void expectFrugal(app::SceneKind kind, Estimator estimator) {
    const Memory m = memoryOfDrive(kind, estimator);
    // Where surfaces come near, the default keeps what their cells' evidence follows from.
    EXPECT_LE(m.said / static_cast<double>(m.cells), estimator == Estimator::surface ? 28 : 16);
    if (sanitized()) GTEST_SKIP() << "a sanitizer's allocator keeps no such count";
    EXPECT_NEAR(m.said, m.given, 0.03 * m.given);
}

}  // namespace

TEST(Memory, StructuredSceneTakesFewBytesACell) {
    expectFrugal(app::SceneKind::structured, Estimator::surface);
}

TEST(Memory, UnstructuredSceneTakesFewBytesACell) {
    expectFrugal(app::SceneKind::unstructured, Estimator::surface);
}

TEST(Memory, ThePapersMethodTakesFewBytesACell) {
    expectFrugal(app::SceneKind::structured, Estimator::paper);
}

TEST(Memory, ALoadedMapSaysWhatItTakes) {
    if (sanitized()) GTEST_SKIP() << "a sanitizer's allocator keeps no such count";
    AkiMap map(0.05);
    map.insertRays(app::simulatedRays({}).front());
    const TemporaryFolder folder;
    const std::string file = folder.file("map.akimap");
    map.saveToFile(file);
    AkiMap::loadFromFile(file).reset();  // what MRPT keeps from its first use
    const double before = allocated();
    const auto loaded = AkiMap::loadFromFile(file);
    const double given = allocated() - before;
    EXPECT_NEAR(static_cast<double>(loaded->memoryBytes()), given, 0.03 * given);
}
