// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers

// Shows a map file in an MRPT window, until it is closed or for so many seconds.
// Usage: show_in_window MAP.akimap [--seconds N]
#include <akimap/AkiMap.h>
#include <mrpt/gui/CDisplayWindow3D.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

namespace {

void show(const std::string& file, double seconds) {
    const auto map = akimap::AkiMap::loadFromFile(file);
    if (!std::getenv("DISPLAY")) throw std::runtime_error("no display to open a window on");
    const auto box = map->boundingBox();
    const auto center = (box.min + box.max) * 0.5f;

    mrpt::gui::CDisplayWindow3D window("akimap: " + file, 960, 720);
    auto cells = mrpt::opengl::CSetOfObjects::Create();
    map->getVisualizationInto(*cells);
    window.get3DSceneAndLock()->insert(cells);  // a thread of the window's own draws the scene
    window.unlockAccess3DScene();
    window.setCameraPointingToPoint(center.x, center.y, center.z);
    window.setCameraZoom(1.5f * (box.max - box.min).norm());
    window.forceRepaint();

    const auto start = std::chrono::steady_clock::now();
    const auto shown = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    while (window.isOpen() && shown() < seconds)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace

int main(int argc, char** argv) {
    const bool timed = argc == 4 && std::string(argv[2]) == "--seconds";
    if (argc != 2 && !timed) {
        std::cerr << "usage: show_in_window MAP.akimap [--seconds N]\n";
        return 2;
    }
    try {
        show(argv[1], timed ? std::stod(argv[3]) : 1e9);
    } catch (const std::exception& e) {
        std::cerr << "show_in_window: " << e.what() << "\n";
        return 1;
    }
}
