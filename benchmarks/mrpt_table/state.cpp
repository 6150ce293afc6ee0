// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <set>

#include "Row.h"
#include "mrpt/mrpt_compat.h"

namespace akimap::bench {
namespace {

using mrpt::maps::CMetricMap;
namespace fs = std::filesystem;

std::string clearing(const MapKind& kind) {
    const auto map = kind.make();
    if (!map->isEmpty()) return "a new one is not empty";
    const Sample s = plainSample();
    map->insertObservation(*s.observation, s.robot);
    if (map->isEmpty()) return "a filled one is empty";
    map->clear();
    return map->isEmpty() ? "works" : "not empty when cleared";
}

/** At the plain sample's returns and on the way to them. */
std::vector<double> occupancies(const MapKind& kind, const CMetricMap& map) {
    std::vector<double> all;
    const Sample s = plainSample();
    for (const double part : {0.3, 0.5, 1.0})
        for (const auto& p : s.in_sensor)
            all.push_back(kind.occupancy(map, s.sensor().composePoint(p * part)));
    return all;
}

/** A filled map with an option and a generic parameter changed. */
struct Original {
    explicit Original(const MapKind& kind) : map(filledMap(kind)) {
        kind.set_max_range(*map, 7);
        map->genericMapParams.enableObservationLikelihood = false;
        occupancy = occupancies(kind, *map);
    }
    CMetricMap::Ptr map;
    std::vector<double> occupancy;  ///< before any copying
};

/** What a copy has lost. */
std::string compare(const MapKind& kind, const Original& original, const CMetricMap::Ptr& copied) {
    if (!copied) return "comes back as nothing";
    CMetricMap &map = *original.map, &copy = *copied;
    std::string lost;
    const auto loses = [&](const char* what) {
        lost += (lost.empty() ? "" : ", ") + std::string(what);
    };
    if (occupancies(kind, copy) != original.occupancy) loses("occupancy");
    if (kind.max_range(copy) != 7) loses("options");
    if (copy.genericMapParams.enableObservationLikelihood) loses("generic parameters");
    if (occupancies(kind, map) != original.occupancy) loses("the original's occupancy too");
    if (!lost.empty()) return "loses " + lost;
    const Sample s = plainSample();
    map.insertObservation(*s.observation, s.robot), copy.insertObservation(*s.observation, s.robot);
    return bytesOf(copy) == bytesOf(map) ? "equal" : "equal, but grows differently";
}

std::string roundTrip(const MapKind& kind) {
    const Original original(kind);
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << *original.map;
    stream.Seek(0);
    return compare(kind, original, std::dynamic_pointer_cast<CMetricMap>(archive.ReadObject()));
}

std::string ownCopy(const MapKind& kind) {
    const Original original(kind);
    const auto copy = original.map->duplicateGetSmartPtr();
    return compare(kind, original, std::dynamic_pointer_cast<CMetricMap>(copy));
}

std::string multiMapCopy(const MapKind& kind) {
    const Original original(kind);
    mrpt::maps::CMultiMetricMap maps;
    maps.maps.push_back(original.map);
    const mrpt::maps::CMultiMetricMap copy = maps;
    return compare(kind, original, copy.maps.at(0));
}

std::string save(const MapKind& kind, const std::string& folder) {
    const fs::path own = fs::path(folder) / ("saved-" + kind.name);
    fs::create_directories(own);
    filledMap(kind)->saveMetricMapRepresentationToFile((own / "NAME").string());
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(own))
        names.insert("`" + entry.path().filename().string() + "`");
    std::string all;
    for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
    return all.empty() ? "no files" : all;
}

std::string picture(const MapKind& kind) {
    const auto map = filledMap(kind);
    mrpt::opengl::CSetOfObjects shown, hidden;
    map->getVisualizationInto(shown);
    map->genericMapParams.enableSaveAs3DObject = false;
    map->getVisualizationInto(hidden);
    const std::string text = shown.size() > 0 ? "works" : "shows nothing";
    return hidden.size() == 0 ? text : text + ", `enableSaveAs3DObject = false` ignored";
}

/** Its first words. */
std::string text(const MapKind& kind) {
    const std::string all = filledMap(kind)->asString();
    return all.empty() ? "empty" : "\"" + all.substr(0, all.find(',')) + "...\"";
}

std::string insertionOff(const MapKind& kind) {
    const auto map = kind.make();
    map->genericMapParams.enableObservationInsertion = false;
    const Sample s = plainSample();
    const std::string before = bytesOf(*map);
    const bool changed = map->insertObservation(*s.observation, s.robot);
    return !changed && bytesOf(*map) == before ? "honoured" : "ignored";
}

std::string likelihoodOff(const MapKind& kind) {
    const auto map = filledMap(kind);
    map->genericMapParams.enableObservationLikelihood = false;
    const Sample s = plainSample();
    return !map->canComputeObservationLikelihood(*s.observation) ? "honoured" : "ignored";
}

std::string cleanUp(const MapKind& kind) {
    const auto map = filledMap(kind);
    const std::string before = bytesOf(*map);
    map->auxParticleFilterCleanUp();
    return bytesOf(*map) == before ? "harmless" : "changes the map";
}

}  // namespace

Section stateRows(const std::string& folder) {
    return {"State",
            "*equal*: a copy has the original's occupancy, options and generic parameters, and is "
            "written as the same bytes after the same insertion into both.",
            {{"`clear`, `isEmpty`", clearing},
             {"written to a stream and read again", roundTrip},
             {"copy of a `CMultiMetricMap` with it", multiMapCopy},
             {"its own copy (`duplicateGetSmartPtr`)", ownCopy},
             {"`saveMetricMapRepresentationToFile(\"NAME\")`",
              [folder](const MapKind& kind) { return save(kind, folder); }},
             {"`getVisualizationInto`", picture},
             {"`asString`", text},
             {"`getAsSimplePointsMap`",
              [](const MapKind& kind) {
                  const auto map = filledMap(kind);
                  return std::string(map->getAsSimplePointsMap() ? "a points map" : "nullptr");
              }},
             {"`auxParticleFilterCleanUp`", cleanUp},
             {"`enableObservationInsertion = false`", insertionOff},
             {"`enableObservationLikelihood = false`", likelihoodOff}}};
}

}  // namespace akimap::bench
