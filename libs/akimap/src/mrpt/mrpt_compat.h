// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the akimap developers
#pragma once

#include <mrpt/config.h>
#include <mrpt/version.h>

// Every seam between the MRPT versions that this library is built against.
// MRPT_VERSION reads 0x258 (2.5.8) up to 2.10.1 and 0x020b03 (2.11.3) from 2.10.2 on.

#define AKIMAP_MRPT_AT_LEAST(hex) (MRPT_VERSION >= (hex))

#if AKIMAP_MRPT_AT_LEAST(0x020700)
#include <mrpt/opengl/Scene.h>
#else
#include <mrpt/opengl/COpenGLScene.h>
#endif

namespace akimap {
#if AKIMAP_MRPT_AT_LEAST(0x020700)
using SceneObject = mrpt::opengl::Scene;
#else
using SceneObject = mrpt::opengl::COpenGLScene;
#endif
}  // namespace akimap

/** From 2.11.3 map factories return a shared pointer. */
#if AKIMAP_MRPT_AT_LEAST(0x020b03)
#define AKIMAP_NEW_MAP_RESULT mrpt::maps::CMetricMap::Ptr
#define AKIMAP_NEW_MAP(...) akimap::AkiMap::Create(__VA_ARGS__)
#else
#define AKIMAP_NEW_MAP_RESULT mrpt::maps::CMetricMap*
#define AKIMAP_NEW_MAP(...) new akimap::AkiMap(__VA_ARGS__)
#endif

/** CObservationRotatingScan::organizedPoints is filled from 2.11.4 on. */
#define AKIMAP_HAS_ROTATING_SCAN AKIMAP_MRPT_AT_LEAST(0x020b04)
