#pragma once

#include <CLI/CLI.hpp>

#include <mimicry/assets/canvas.h>
#include <mimicry/spatial/target.h>

#include "lab/study_shapes.h"

namespace mimicry::cli {

/// How meshes are named on the command line, for help texts.
inline constexpr const char* kMeshHelp =
    "a mesh file (.obj .ply .stl .off .glb .gltf; .mimicry: the mesh that was baked) or a built-in "
    "shape (shape:NAME[:RESOLUTION])";

/// Accepts finite numbers from `lowest` to `highest`.
CLI::Validator number_between(double lowest, double highest);

/// --threads.
void add_threads_option(CLI::App& command, int& threads);
/// --no-cache.
void add_cache_option(CLI::App& command, BakeSettings& settings);
/// --no-join, --strict and the former --allow-nonmanifold, which says that it is not needed.
void add_target_options(CLI::App& command, TargetOptions& options);
/// --shapes, --targets and --only.
void add_study_shape_options(CLI::App& command, lab::StudyShapeOptions& options);

}  // namespace mimicry::cli
