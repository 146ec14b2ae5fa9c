/* registry.c - THE tables: one row per kind of thing. To add a shape or a pattern, write its file and its row here. */
#include "registry.h"

#include <stddef.h>

#define SHAPES(ROW) \
    ROW(blob) ROW(height_field) ROW(julia_fractal) ROW(lathe) ROW(ovus) ROW(prism) ROW(sor) \
    ROW(sphere_sweep) ROW(text) ROW(isosurface) ROW(parametric) ROW(box) ROW(cone) ROW(cylinder) \
    ROW(disc) ROW(plane) ROW(smooth_triangle) ROW(sphere) ROW(torus) ROW(triangle) ROW(mesh) ROW(mesh2) \
    ROW(quadric) ROW(cubic) ROW(quartic) ROW(poly) ROW(polynomial) ROW(polygon) ROW(bicubic_patch) \
    ROW(superellipsoid)

#define PATTERNS(ROW) \
    ROW(bozo) ROW(spotted) ROW(bumps) ROW(dents) ROW(granite) ROW(wrinkles) ROW(agate) ROW(marble) \
    ROW(wood) ROW(checker) ROW(square) ROW(triangular) ROW(hexagon) ROW(cubic) ROW(brick) ROW(gradient) \
    ROW(planar) ROW(spherical) ROW(cylindrical) ROW(boxed) ROW(onion) ROW(radial) ROW(leopard) \
    ROW(image_pattern) ROW(pigment_pattern) ROW(object) ROW(spiral1) ROW(spiral2) ROW(ripples) ROW(waves) \
    ROW(quilted) ROW(crackle) ROW(cells) ROW(mandel) ROW(julia) ROW(magnet) ROW(density_file) ROW(slope) \
    ROW(aoi) ROW(tiling) ROW(pavement) ROW(function)

#define DECLARE_SHAPE(name) extern const ShapeOps shape_##name;
#define DECLARE_PATTERN(name) extern const PatternOps pattern_##name;
#define COLLECT_SHAPE(name) &shape_##name,
#define COLLECT_PATTERN(name) &pattern_##name,

SHAPES(DECLARE_SHAPE)
PATTERNS(DECLARE_PATTERN)

static const ShapeOps *const shapes[] = { SHAPES(COLLECT_SHAPE) NULL };
static const PatternOps *const patterns[] = { PATTERNS(COLLECT_PATTERN) NULL };

const Registry registry = { shapes, patterns };
