/* The C interface of mimicry, for other languages and engines.
 *
 * Objects are opaque handles: made by a function with `out` as its last argument, given back with
 * `..._destroy` (NULL is fine). An object keeps alive what it needs: handles may be destroyed in
 * any order. Every function that can fail returns a status; its message is
 * `mimicry_last_error()`. On failure `*out` is NULL and nothing else is written. NULL where a
 * pointer is needed is MIMICRY_INVALID_INPUT.
 *
 * World: right-handed, y up, metres. Devices point along their -z axis with +y up (OpenXR, WebXR,
 * glTF). Model: the mesh's own coordinates and units. Quaternions are x, y, z, w. Texts are UTF-8
 * and end in 0. Pointers that a function hands out are the object's and live as long as it does,
 * but where said otherwise.
 *
 * Different objects may be used from different threads, and meshes, targets and curves by several
 * at once; one session or one set of strokes by one thread at a time.
 */
#ifndef MIMICRY_MIMICRY_H
#define MIMICRY_MIMICRY_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define MIMICRY_API __attribute__((visibility("default")))
#else
#define MIMICRY_API
#endif

/* In C any number may stand in an enumeration; without a fixed type C++ could not even look at one
 * that has no name. */
#ifdef __cplusplus
#define MIMICRY_INT : int
#else
#define MIMICRY_INT
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mimicry_status MIMICRY_INT {
  MIMICRY_OK = 0,
  MIMICRY_INVALID_INPUT = 1, /* a file, mesh, pose or option that cannot be used as it is */
  MIMICRY_IO = 2,
  MIMICRY_UNSUPPORTED = 3, /* well-formed, but of a version or kind that is not handled */
  MIMICRY_CANCELLED = 4,   /* stopped by the progress callback */
  MIMICRY_OUT_OF_MEMORY = 5,
  MIMICRY_FAILED = 6 /* a fault in this library */
} mimicry_status;

/* What went wrong in the last call of this thread that failed: a sentence with thing, place and
 * remedy. Never NULL. Lives until the next failure in this thread. */
MIMICRY_API const char* mimicry_last_error(void);

/* Increased when a function or structure changes incompatibly. */
#define MIMICRY_ABI_VERSION 1
MIMICRY_API int32_t mimicry_abi_version(void);

typedef struct mimicry_mesh mimicry_mesh;             /* triangles, however broken */
typedef struct mimicry_target mimicry_target;         /* a mesh ready to be drawn on */
typedef struct mimicry_session mimicry_session;       /* frames in, curve out */
typedef struct mimicry_curve mimicry_curve;           /* a curve on a target */
typedef struct mimicry_curve_list mimicry_curve_list; /* what a curve file holds */
typedef struct mimicry_strokes mimicry_strokes;       /* recorded strokes */
typedef struct mimicry_tube mimicry_tube;             /* a curve as triangles */
typedef struct mimicry_bytes mimicry_bytes;           /* a file's content */

MIMICRY_API const uint8_t* mimicry_bytes_data(const mimicry_bytes* bytes);
MIMICRY_API size_t mimicry_bytes_size(const mimicry_bytes* bytes);
MIMICRY_API void mimicry_bytes_destroy(mimicry_bytes* bytes);

/* Meshes ------------------------------------------------------------------------------------- */

/* positions: 3 vertex_count, any unit. faces: 3 face_count vertex numbers from 0,
 * counter-clockwise seen from outside. Both are copied. name: for messages, may be NULL. */
MIMICRY_API mimicry_status mimicry_mesh_create(const double* positions, size_t vertex_count,
                                               const int32_t* faces, size_t face_count,
                                               const char* name, mimicry_mesh** out);
/* A file's content. name: its ending tells the format (.obj .ply .stl .off .glb .gltf) and it
 * stands in messages. */
MIMICRY_API mimicry_status mimicry_mesh_read(const void* data, size_t size, const char* name,
                                             mimicry_mesh** out);

/* A file that is held in memory. The name may begin with folders, "model/cube.gltf". */
typedef struct mimicry_file {
  const char* name;
  const void* data;
  size_t size;
} mimicry_file;

/* A mesh with the files that it names: a glTF and its buffers. They are found by their place
 * relative to the mesh, else by their name alone; others (textures) may be among them. mesh: the
 * mesh's name among the files, or NULL where it is the only mesh. */
MIMICRY_API mimicry_status mimicry_mesh_read_files(const mimicry_file* files, size_t count,
                                                   const char* mesh, mimicry_mesh** out);
/* A built-in shape. resolution: 0 for its default. */
MIMICRY_API mimicry_status mimicry_mesh_shape(const char* name, int32_t resolution,
                                              mimicry_mesh** out);
MIMICRY_API void mimicry_mesh_destroy(mimicry_mesh* mesh);

MIMICRY_API size_t mimicry_mesh_vertex_count(const mimicry_mesh* mesh);
MIMICRY_API size_t mimicry_mesh_face_count(const mimicry_mesh* mesh);
MIMICRY_API const double* mimicry_mesh_positions(const mimicry_mesh* mesh); /* #V by 3 */
MIMICRY_API const int32_t* mimicry_mesh_faces(const mimicry_mesh* mesh);    /* #F by 3 */
/* The size at which it is suggested to be shown: a shape's own; of others the bounding box's
 * diagonal is 0.6 m. */
MIMICRY_API double mimicry_mesh_metres_per_unit(const mimicry_mesh* mesh);

typedef struct mimicry_mesh_report {
  double box_min[3];
  double box_max[3];
  double diagonal;
  double area;
  double volume; /* enclosed; NaN where the mesh is not closed and consistently oriented */
  int32_t vertices;
  int32_t edges;
  int32_t faces;
  int32_t components;
  int32_t boundary_loops;
  int32_t genus; /* sum of the components'; -1 where one has none */
  int32_t manifold;
  int32_t closed;
  int32_t invalid_vertices; /* not finite, or too far away */
  int32_t nonmanifold_edges;
  int32_t nonmanifold_vertices;
  int32_t inconsistent_edges;
  int32_t degenerate_faces;
  int32_t duplicate_faces;
} mimicry_mesh_report;

/* Looks at any mesh: counts and findings are the mesh's own; box, area, volume, edges, components,
 * boundary, genus, manifold and closed are those of the surface that a target of it is drawn on.
 * O(n log n). */
MIMICRY_API mimicry_status mimicry_mesh_validate(const mimicry_mesh* mesh,
                                                 mimicry_mesh_report* report);

typedef struct mimicry_shape_info {
  const char* name;
  const char* description;
  int32_t default_resolution;
  int32_t least_resolution;
  int32_t most_resolution;
} mimicry_shape_info;

MIMICRY_API int32_t mimicry_shape_count(void);
/* NULL where there is no such number. */
MIMICRY_API const mimicry_shape_info* mimicry_shape(int32_t number);

/* Targets ------------------------------------------------------------------------------------ */

/* A point on a target: a face of the mesh as it was given, and barycentric coordinates of its
 * corners in the order given. */
typedef struct mimicry_surface_point {
  double position[3]; /* model */
  double normal[3];   /* unit, interpolated between the vertices */
  double barycentric[3];
  double distance; /* from the query: closest point; along the direction: hit */
  int32_t face;    /* -1: there is none */
  int32_t unused;
} mimicry_surface_point;

typedef struct mimicry_target_options {
  int32_t join;   /* join vertices at equal positions at seams; 1 */
  int32_t strict; /* refuse what would be mended; 0 */
} mimicry_target_options;

MIMICRY_API mimicry_target_options mimicry_default_target_options(void);
/* A mesh ready to be drawn on. What is drawn on is the surface that the mesh is meant to be: seams
 * are joined, vertices and edges where sheets meet are split, faces without three places or on top
 * of others are left out, faces that run against their neighbours are turned. The mesh and the
 * numbers of its faces stay as they are. options: NULL for the defaults. O(#F log #F). */
MIMICRY_API mimicry_status mimicry_target_make(const mimicry_mesh* mesh,
                                               const mimicry_target_options* options,
                                               mimicry_target** out);
/* The same with the defaults. allow_nonmanifold is of no effect: every target is a manifold. */
MIMICRY_API mimicry_status mimicry_target_create(const mimicry_mesh* mesh,
                                                 int32_t allow_nonmanifold, mimicry_target** out);
/* What was done to make the surface, a line each; empty where nothing was. */
MIMICRY_API const char* mimicry_target_notes(const mimicry_target* target);
/* The surface: its vertices, and for each the lowest of the mesh's vertices that it joins. */
MIMICRY_API size_t mimicry_target_surface_vertex_count(const mimicry_target* target);
MIMICRY_API const int32_t* mimicry_target_surface_sources(const mimicry_target* target);
/* Corners of the surface's faces, #F by 3. A face that is left out names one vertex three times; of
 * one that was turned the last two corners are exchanged. */
MIMICRY_API const int32_t* mimicry_target_surface_faces(const mimicry_target* target);
/* For each vertex of the mesh one of the surface's; -1 where no face uses it. */
MIMICRY_API const int32_t* mimicry_target_surface_vertices(const mimicry_target* target);
MIMICRY_API void mimicry_target_destroy(mimicry_target* target);
/* #V by 3, for the vertices of the mesh; 0 where no face uses one. */
MIMICRY_API const double* mimicry_target_vertex_normals(const mimicry_target* target);
MIMICRY_API double mimicry_target_diagonal(const mimicry_target* target);

/* The point closest to y (model) within upper_bound; INFINITY for no bound. hint: a face that is
 * probably near, or -1; it saves time and never changes the answer. None is no error: face -1. */
MIMICRY_API mimicry_status mimicry_target_closest_point(const mimicry_target* target,
                                                        const double y[3], double upper_bound,
                                                        int32_t hint, mimicry_surface_point* out);
/* The first point on a ray (model; direction of any length). None is no error: face -1. */
MIMICRY_API mimicry_status mimicry_target_first_hit(const mimicry_target* target,
                                                    const double origin[3],
                                                    const double direction[3],
                                                    mimicry_surface_point* out);

/* A new target: the same one with its bake, the content of a .mimicry file that was made for the
 * same mesh. For techniques that need it. */
MIMICRY_API mimicry_status mimicry_target_with_embedding(const mimicry_target* target,
                                                         const void* data, size_t size,
                                                         const char* name, mimicry_target** out);
MIMICRY_API int32_t mimicry_target_has_embedding(const mimicry_target* target);

/* Called during long work, in the thread that asked for it, with a stage's name and how far it is,
 * 0 to 1. Returning 0 cancels: the function gives MIMICRY_CANCELLED and makes nothing. */
typedef int32_t (*mimicry_progress)(void* user, const char* stage, double fraction);

typedef struct mimicry_bake_options {
  int32_t dimension; /* 3 to 8 */
  int32_t samples;   /* at most */
  double offset;     /* half the shell's thickness, part of the diagonal */
  int32_t threads;   /* at most 256; fewer are used where the system gives no more. Below 1: 1 */
  int32_t unused;
} mimicry_bake_options;

MIMICRY_API mimicry_bake_options mimicry_default_bake_options(void);
/* The content of a .mimicry file; seconds to minutes. options, progress: NULL for the defaults and
 * for none. */
MIMICRY_API mimicry_status mimicry_bake(const mimicry_mesh* mesh,
                                        const mimicry_bake_options* options,
                                        mimicry_progress progress, void* user, mimicry_bytes** out);

/* Techniques --------------------------------------------------------------------------------- */

typedef struct mimicry_option_info {
  const char* name;
  const char* unit;
  const char* description;
  int32_t count; /* of its numbers: 1, or the 3 of a vector */
  int32_t unused;
  double defaults[3];
  double lowest; /* of each number */
  double highest;
} mimicry_option_info;

typedef struct mimicry_technique_info {
  const char* name;
  const char* description; /* a line */
  const char* source;      /* section or equation of the paper */
  int32_t anchored;        /* looks at the last point too */
  int32_t needs_bake;
  int32_t option_count;
  const mimicry_option_info* options;
} mimicry_technique_info;

MIMICRY_API int32_t mimicry_technique_count(void);
/* NULL where there is no such number. */
MIMICRY_API const mimicry_technique_info* mimicry_technique(int32_t number);

/* Sessions ----------------------------------------------------------------------------------- */

/* x_world = scale (rotation x_model) + translation */
typedef struct mimicry_similarity {
  double rotation[4]; /* unit quaternion x, y, z, w */
  double translation[3];
  double scale; /* metres per model unit, > 0 */
} mimicry_similarity;

/* One sample of head and controller in the world. 17 doubles. */
typedef struct mimicry_frame {
  double time_s; /* any clock that does not run backwards */
  double head_position[3];
  double head_orientation[4];
  double controller_position[3]; /* the pen's tip */
  double controller_orientation[4];
  double trigger;  /* 0 to 1 */
  double pressure; /* 0 to 1; below 0 where there is none */
} mimicry_frame;

typedef enum mimicry_frame_status MIMICRY_INT {
  MIMICRY_FRAME_INKED = 0,
  MIMICRY_FRAME_MISSED = 1,  /* the point is undefined */
  MIMICRY_FRAME_STILL = 2,   /* passed over: less motion than the minimum */
  MIMICRY_FRAME_REJECTED = 3 /* not usable, or no stroke is open: passed over */
} mimicry_frame_status;

/* A vertex of what is drawn: the curve's points and every edge that it crosses, in order. */
typedef struct mimicry_ink {
  float position[3]; /* model */
  float normal[3];   /* unit, of the surface */
  int32_t frame;     /* of the point that the piece leads to, counted from 0 in the stroke */
  int32_t starts;    /* 1: not joined to the vertex before */
} mimicry_ink;

/* Keeps the target alive. technique: its name. */
MIMICRY_API mimicry_status mimicry_session_create(const mimicry_target* target,
                                                  const char* technique, mimicry_session** out);
MIMICRY_API void mimicry_session_destroy(mimicry_session* session);
/* Sets an option of the technique; it holds from the next stroke on. */
MIMICRY_API mimicry_status mimicry_session_set_option(mimicry_session* session, const char* name,
                                                      const double* values, size_t count);
/* Frames whose pen is nearer than this to the last inked one's are passed over; 0 at first. From
 * the next stroke on. */
MIMICRY_API mimicry_status mimicry_session_set_minimum_motion(mimicry_session* session,
                                                              double metres);
/* Whether a frame without a point breaks the curve (1) or is bridged (0, at first; the paper).
 * From the next stroke on. */
MIMICRY_API mimicry_status mimicry_session_set_split_at_misses(mimicry_session* session,
                                                               int32_t split);
/* Starts a stroke; the last one's ink and curve are forgotten. */
MIMICRY_API mimicry_status mimicry_session_begin(mimicry_session* session,
                                                 const mimicry_similarity* model_to_world);
/* Allocates nothing for thousands of frames. frame_status may be NULL. */
MIMICRY_API mimicry_status mimicry_session_add(mimicry_session* session, const mimicry_frame* frame,
                                               mimicry_frame_status* frame_status);
MIMICRY_API mimicry_status mimicry_session_end(mimicry_session* session);
/* All ink of the stroke; what is there never changes, new ink comes at the end. The pointer lives
 * until the next frame. */
MIMICRY_API const mimicry_ink* mimicry_session_ink(const mimicry_session* session);
MIMICRY_API size_t mimicry_session_ink_count(const mimicry_session* session);
/* The curve so far, copied. */
MIMICRY_API mimicry_status mimicry_session_curve(const mimicry_session* session,
                                                 mimicry_curve** out);
/* A whole stroke at once: begin, all frames, end, curve. Throws nothing away: frames that cannot
 * be used are an error here. */
MIMICRY_API mimicry_status mimicry_session_project(mimicry_session* session,
                                                   const mimicry_similarity* model_to_world,
                                                   const mimicry_frame* frames, size_t count,
                                                   mimicry_curve** out);

/* Curves ------------------------------------------------------------------------------------- */

typedef struct mimicry_curve_point {
  double position[3]; /* model */
  double normal[3];   /* unit */
  double barycentric[3];
  double time_s;
  double pen_distance; /* model units */
  int32_t face;
  int32_t frame;
} mimicry_curve_point;

MIMICRY_API void mimicry_curve_destroy(mimicry_curve* curve);
MIMICRY_API size_t mimicry_curve_point_count(const mimicry_curve* curve);
MIMICRY_API mimicry_status mimicry_curve_point_at(const mimicry_curve* curve, size_t number,
                                                  mimicry_curve_point* out);
MIMICRY_API double mimicry_curve_length(const mimicry_curve* curve); /* model units */
MIMICRY_API int32_t mimicry_curve_is_closed(const mimicry_curve* curve);
MIMICRY_API const char* mimicry_curve_stroke(const mimicry_curve* curve); /* its stroke's id */
MIMICRY_API const char* mimicry_curve_technique(const mimicry_curve* curve);
MIMICRY_API const mimicry_ink* mimicry_curve_ink(const mimicry_curve* curve);
MIMICRY_API size_t mimicry_curve_ink_count(const mimicry_curve* curve);
/* A copy that bears another stroke's id. */
MIMICRY_API mimicry_status mimicry_curve_with_stroke(const mimicry_curve* curve, const char* id,
                                                     mimicry_curve** out);
/* A copy whose tube is as thick as given at each point, and changes linearly between them, as ink
 * drawn with a pen's pressure. radii: one for each point, model units, > 0; NULL: none of its own.
 */
MIMICRY_API mimicry_status mimicry_curve_with_radii(const mimicry_curve* curve, const double* radii,
                                                    mimicry_curve** out);

/* A copy whose tube is raised along the surface's normal in GLB and PLY files. lift: model units,
 * finite. */
MIMICRY_API mimicry_status mimicry_curve_with_lift(const mimicry_curve* curve, double lift,
                                                   mimicry_curve** out);

/* Edits make a new curve on the surface and leave the old one. Radii stay where the points do: in
 * slices and smoothed curves. */
/* Points [first, end) of it; an open curve. */
MIMICRY_API mimicry_status mimicry_curve_slice(const mimicry_curve* curve, size_t first, size_t end,
                                               mimicry_curve** out);
/* count: points at equal steps of length, 2 to 10 million. O(count) short paths. */
MIMICRY_API mimicry_status mimicry_curve_resample(const mimicry_curve* curve, size_t count,
                                                  mimicry_curve** out);
/* strength: 0 to 1. iterations: 0 to 100000, each of three short paths a point. */
MIMICRY_API mimicry_status mimicry_curve_smooth(const mimicry_curve* curve, double strength,
                                                int32_t iterations, mimicry_curve** out);
/* tolerance: model units. At worst, the square of the points. */
MIMICRY_API mimicry_status mimicry_curve_simplify(const mimicry_curve* curve, double tolerance,
                                                  mimicry_curve** out);
/* The same three, which may run for minutes on long curves, where they can be cancelled. progress:
 * NULL for none. */
MIMICRY_API mimicry_status mimicry_curve_resample_with_progress(const mimicry_curve* curve,
                                                                size_t count,
                                                                mimicry_progress progress,
                                                                void* user, mimicry_curve** out);
MIMICRY_API mimicry_status mimicry_curve_smooth_with_progress(const mimicry_curve* curve,
                                                              double strength, int32_t iterations,
                                                              mimicry_progress progress, void* user,
                                                              mimicry_curve** out);
MIMICRY_API mimicry_status mimicry_curve_simplify_with_progress(const mimicry_curve* curve,
                                                                double tolerance,
                                                                mimicry_progress progress,
                                                                void* user, mimicry_curve** out);
/* Joins the end to the start by the shortest path; fails where the surface does not join them. */
MIMICRY_API mimicry_status mimicry_curve_close(const mimicry_curve* curve, mimicry_curve** out);

/* A round tube around the curve. radius: model units, > 0; of a curve without radii. sides: 3 to
 * 1024. lift: model units by which the curve is raised along the surface's normal. */
MIMICRY_API mimicry_status mimicry_curve_tube(const mimicry_curve* curve, double radius,
                                              int32_t sides, double lift, mimicry_tube** out);
MIMICRY_API void mimicry_tube_destroy(mimicry_tube* tube);
MIMICRY_API size_t mimicry_tube_vertex_count(const mimicry_tube* tube);
MIMICRY_API size_t mimicry_tube_face_count(const mimicry_tube* tube);
MIMICRY_API const float* mimicry_tube_positions(const mimicry_tube* tube); /* #V by 3, model */
MIMICRY_API const float* mimicry_tube_normals(const mimicry_tube* tube);   /* #V by 3, unit */
MIMICRY_API const uint32_t* mimicry_tube_faces(const mimicry_tube* tube);  /* #F by 3 */

typedef enum mimicry_curve_format MIMICRY_INT {
  MIMICRY_CURVES_JSON = 0,
  MIMICRY_CURVES_OBJ = 1,
  MIMICRY_CURVES_CSV = 2,
  MIMICRY_CURVES_PLY = 3,           /* tubes */
  MIMICRY_CURVES_GLB = 4,           /* the target, and tubes */
  MIMICRY_CURVES_OBJ_POLYLINES = 5, /* one long line element a part; some importers lose it */
  MIMICRY_CURVES_PLY_LINES = 6,     /* edge elements, which few readers know */
  MIMICRY_CURVES_GLB_LINES = 7,     /* the target, and line strips */
  MIMICRY_CURVES_PACKED = 8         /* raw numbers: fast, for keeping and handing on */
} mimicry_curve_format;

/* A file of curves on one target. colors: count by 3, sRGB (NULL: black; PLY and GLB only).
 * tube_radius: model units, > 0; of curves without radii, in formats with tubes. */
MIMICRY_API mimicry_status mimicry_curves_write(const mimicry_target* target,
                                                const char* target_name,
                                                const mimicry_curve* const* curves, size_t count,
                                                mimicry_curve_format format, const uint8_t* colors,
                                                double tube_radius, mimicry_bytes** out);
/* A JSON or packed file of curves on this target. */
MIMICRY_API mimicry_status mimicry_curves_read(const mimicry_target* target, const void* data,
                                               size_t size, const char* name,
                                               mimicry_curve_list** out);
MIMICRY_API size_t mimicry_curve_list_count(const mimicry_curve_list* list);
/* A curve of the list, to be destroyed by itself. */
MIMICRY_API mimicry_status mimicry_curve_list_get(const mimicry_curve_list* list, size_t number,
                                                  mimicry_curve** out);
MIMICRY_API void mimicry_curve_list_destroy(mimicry_curve_list* list);

/* Strokes ------------------------------------------------------------------------------------ */

MIMICRY_API mimicry_status mimicry_strokes_create(mimicry_strokes** out); /* none yet */
/* The sound strokes of a mimicry-strokes file (docs/formats.md), whatever its convention. A stroke
 * with a frame or a field that cannot be used is left out as a whole and does not refuse the
 * others. Fails where the fault is the file's, or no stroke is sound and some were left out. */
MIMICRY_API mimicry_status mimicry_strokes_read(const void* data, size_t size, const char* name,
                                                mimicry_strokes** out);
/* What was left out of the file: how much, and of each the place, the fault and the remedy; NULL
 * where there is no such number. */
MIMICRY_API size_t mimicry_strokes_left_out_count(const mimicry_strokes* strokes);
MIMICRY_API const char* mimicry_strokes_left_out(const mimicry_strokes* strokes, size_t number);
MIMICRY_API mimicry_status mimicry_strokes_append(mimicry_strokes* strokes, const char* id,
                                                  const char* target_name,
                                                  const mimicry_similarity* model_to_world,
                                                  const mimicry_frame* frames, size_t count);
MIMICRY_API mimicry_status mimicry_strokes_write(const mimicry_strokes* strokes,
                                                 mimicry_bytes** out);
MIMICRY_API size_t mimicry_strokes_count(const mimicry_strokes* strokes);
/* Of a stroke: NULL, 0 where there is no such number. */
MIMICRY_API const char* mimicry_strokes_id(const mimicry_strokes* strokes, size_t number);
MIMICRY_API const char* mimicry_strokes_target(const mimicry_strokes* strokes, size_t number);
MIMICRY_API size_t mimicry_strokes_frame_count(const mimicry_strokes* strokes, size_t number);
MIMICRY_API mimicry_status mimicry_strokes_placement(const mimicry_strokes* strokes, size_t number,
                                                     mimicry_similarity* out);
/* frames: room for all of the stroke's. */
MIMICRY_API mimicry_status mimicry_strokes_frames(const mimicry_strokes* strokes, size_t number,
                                                  mimicry_frame* frames);
MIMICRY_API void mimicry_strokes_destroy(mimicry_strokes* strokes);

#ifdef __cplusplus
}
#endif

#endif
