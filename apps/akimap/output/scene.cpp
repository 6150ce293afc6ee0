// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <zlib.h>

#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "output/formats.h"
#include "pictures/MapCells.h"
#include "pictures/faces.h"

namespace akimap::app {

namespace {

constexpr std::size_t kMaxFaces = 1000000;  // some 220 MB in the viewer

mrpt::opengl::TTriangle triangle(const Face& face, std::size_t b, std::size_t c, double side) {
    mrpt::opengl::TTriangle t;
    const std::size_t corners[3] = {0, b, c};
    for (std::size_t i = 0; i < 3; i++) {
        const auto& p = face.corners[corners[i]];
        t.vertices[i].xyzrgba.pt = {static_cast<float>(p[0] * side),
                                    static_cast<float>(p[1] * side),
                                    static_cast<float>(p[2] * side)};
    }
    t.computeNormals();
    t.setColor(mrpt::img::TColorf(0.55f, 0.6f, 0.66f, 0.25f));
    return t;
}

/** Where free space ends in the unknown, as translucent grey faces. Without those that look down:
 * seen from above they would be a lid on everything, and the file can't say that their backs
 * are not to be drawn. */
mrpt::opengl::CSetOfTriangles::Ptr unknownSurface(const MapCells& cells, double resolution) {
    auto surface = mrpt::opengl::CSetOfTriangles::Create();
    std::size_t faces = 0;
    forEachExposedFace(unknownCells(cells), [&](const Face& face) {
        const bool looks_down = face.axis == 2 && face.side == 0;
        if (looks_down || !cells.free.contains(beyond(face.cell, face.axis, face.side))) return;
        if (++faces > kMaxFaces)
            throw std::runtime_error("--unknown: the unknown has more than " +
                                     std::to_string(kMaxFaces) + " faces, too many for a viewer");
        surface->insertTriangle(triangle(face, 1, 2, resolution));
        surface->insertTriangle(triangle(face, 2, 3, resolution));
    });
    surface->setName("unknown");
    // MRPT draws near objects last, and what is translucent must be, to show the cells behind it.
    surface->setLocalRepresentativePoint({0, 0, 1e4f});
    return surface;
}

/** A light's share: a color before MRPT 2.7, a number from there on. */
template <class Share>
void setShare(Share& share, float brightness) {
    if constexpr (std::is_same_v<Share, float>)
        share = brightness;
    else
        share = {brightness, brightness, brightness, 1.0f};
}

void setView(mrpt::opengl::COpenGLScene& scene, const AkiMap& map) {
    const auto box = map.boundingBox();
    const auto center = (box.min + box.max) * 0.5f;
    auto& camera = scene.getViewport()->getCamera();
    camera.setPointingAt(center.x, center.y, center.z);
    camera.setZoomDistance(1.7f * (box.max - box.min).norm());
    camera.setAzimuthDegrees(-60);
    camera.setElevationDegrees(45);
    auto& light = scene.getViewport()->lightParameters();
    setShare(light.ambient, 0.5f);  // by default walls in the shade are black
    setShare(light.diffuse, 0.5f);
}

/** MRPT does not tell whether the last, compressed block found room on the disk. */
bool isWholeGz(const std::string& path) {
    const gzFile file = gzopen(path.c_str(), "rb");
    if (!file) return false;
    std::vector<char> buffer(1 << 20);
    int n = 1;
    while (n > 0) n = gzread(file, buffer.data(), static_cast<unsigned>(buffer.size()));
    return gzclose(file) == Z_OK && n == 0;
}

}  // namespace

void writeScene(const AkiMap& map, const std::string& path, const ExportOptions& options) {
    AkiMap drawn(map);
    drawn.renderingOptions.threshold = options.threshold;
    drawn.genericMapParams.enableSaveAs3DObject = true;
    auto objects = mrpt::opengl::CSetOfObjects::Create();
    objects->setName("akimap");
    drawn.getVisualizationInto(*objects);

    mrpt::opengl::COpenGLScene scene;
    scene.insert(objects);
    if (options.unknown && !map.isEmpty())
        scene.insert(unknownSurface(cellsOf(map, options.threshold), map.resolution()));
    setView(scene, map);
    if (!scene.saveToFile(path) || !isWholeGz(path))
        throw std::runtime_error("the scene could not be written whole (is the disk full?)");
}

}  // namespace akimap::app
