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
 * at once; one session, set of strokes, path finder, exponential map, or search for a path by one
 * thread at a time.
 */
#ifndef MIMICRY_MIMICRY_H
#define MIMICRY_MIMICRY_H

#include <stddef.h>
#include <stdint.h>

/* MIMICRY_EXPORTS: mimicry.dll is being built. MIMICRY_DLL: it is being used (not needed: calls go
 * through one more jump then). */
#if defined(_WIN32)
#if defined(MIMICRY_EXPORTS)
#define MIMICRY_API __declspec(dllexport)
#elif defined(MIMICRY_DLL)
#define MIMICRY_API __declspec(dllimport)
#else
#define MIMICRY_API
#endif
#elif defined(__GNUC__)
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
#define MIMICRY_ABI_VERSION 2
MIMICRY_API int32_t mimicry_abi_version(void);

typedef struct mimicry_mesh mimicry_mesh;             /* triangles, however broken */
typedef struct mimicry_target mimicry_target;         /* a mesh ready to be drawn on */
typedef struct mimicry_session mimicry_session;       /* frames in, curve out */
typedef struct mimicry_curve mimicry_curve;           /* a curve on a target */
typedef struct mimicry_curve_list mimicry_curve_list; /* what a curve file holds */
typedef struct mimicry_strokes mimicry_strokes;       /* recorded strokes */
typedef struct mimicry_tube mimicry_tube;             /* a curve as triangles */
typedef struct mimicry_bytes mimicry_bytes;           /* a file's content */
typedef struct mimicry_geodesics mimicry_geodesics; /* distances from sources, and paths to them */
typedef struct mimicry_path_finder
    mimicry_path_finder; /* paths between points, the last one kept */
typedef struct mimicry_exponential_map mimicry_exponential_map; /* a patch laid out in a plane */
typedef struct mimicry_target_curves mimicry_target_curves;     /* intended curves of a study */

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

/* What a mesh's file tells beside its geometry, which nothing here looks at. Corners name their
 * values by number: corners of one vertex that name different ones lie at a seam. */
typedef struct mimicry_corner_values {
  const float* values; /* count by 2 or 4 */
  size_t count;
  const int32_t* corners; /* #F by 3: the number of the corner's value, -1: it has none.
                             NULL: the mesh carries none */
} mimicry_corner_values;

/* Texture coordinates u, v; v up. */
MIMICRY_API mimicry_corner_values mimicry_mesh_texcoords(const mimicry_mesh* mesh);
/* Linear red, green, blue and alpha. */
MIMICRY_API mimicry_corner_values mimicry_mesh_colors(const mimicry_mesh* mesh);

typedef enum mimicry_label_kind MIMICRY_INT {
  MIMICRY_GROUPS = 0,
  MIMICRY_MATERIALS = 1,
  MIMICRY_OBJECTS = 2
} mimicry_label_kind;

/* #F: the number of the face's name, -1: it has none. NULL: the mesh carries none. */
MIMICRY_API const int32_t* mimicry_mesh_face_labels(const mimicry_mesh* mesh,
                                                    mimicry_label_kind kind);
MIMICRY_API size_t mimicry_mesh_label_count(const mimicry_mesh* mesh, mimicry_label_kind kind);
/* NULL where there is no such number. */
MIMICRY_API const char* mimicry_mesh_label_name(const mimicry_mesh* mesh, mimicry_label_kind kind,
                                                size_t number);

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

/* How a technique, or a query for smooth points, found a point. */
typedef enum mimicry_answer MIMICRY_INT {
  MIMICRY_NO_POINT = 0,
  MIMICRY_RAY = 1,     /* first hit of a ray */
  MIMICRY_CLOSEST = 2, /* closest point of the surface */
  MIMICRY_SMOOTH = 3,  /* a smooth projection */
  MIMICRY_SECTION = 4, /* end of a walk along the surface, or closest point of a section of it */
  /* closest points in place of smooth ones: */
  MIMICRY_OUTSIDE_SHELL = 5,
  MIMICRY_NO_SMOOTH_POINT = 6,
  MIMICRY_REPLACED = 7
} mimicry_answer;

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

/* The same for many points: points #count by 3, out #count. upper_bound: at least 0. */
MIMICRY_API mimicry_status mimicry_target_closest_points(const mimicry_target* target,
                                                         const double* points, size_t count,
                                                         double upper_bound,
                                                         mimicry_surface_point* out);
/* origins, directions: #count by 3. */
MIMICRY_API mimicry_status mimicry_target_first_hits(const mimicry_target* target,
                                                     const double* origins,
                                                     const double* directions, size_t count,
                                                     mimicry_surface_point* out);

/* Moves the mesh's vertices: positions #V by 3, of the mesh as it was given. Sessions on the target
 * draw on the moved surface from their next frame on; curves stay where they were until
 * mimicry_curve_follow; distances (mimicry_geodesics) are to be made anew. Nothing else may use the
 * target, or what stands on it, during the call. Fails, and changes nothing, where the count is
 * another one, the positions could not be a target's, or the target has been given a bake, which is
 * of one shape. Allocates nothing. O(#F). */
MIMICRY_API mimicry_status mimicry_target_update_positions(mimicry_target* target,
                                                           const double* positions,
                                                           size_t vertex_count);

/* A new target: the same one with its bake, the content of a .mimicry file that was made for the
 * same mesh. For techniques that need it. */
MIMICRY_API mimicry_status mimicry_target_with_embedding(const mimicry_target* target,
                                                         const void* data, size_t size,
                                                         const char* name, mimicry_target** out);
MIMICRY_API int32_t mimicry_target_has_embedding(const mimicry_target* target);
/* The smooth closest points of points (#count by 3, model) on a target with its bake. out: #count,
 * `distance` in a straight line. answers: how each was found, NULL or #count: MIMICRY_SMOOTH, or
 * why it is a closest point instead. replace_failed: 1 to replace those that fail the paper's test.
 */
MIMICRY_API mimicry_status mimicry_target_smooth_closest_points(const mimicry_target* target,
                                                                const double* points, size_t count,
                                                                int32_t replace_failed,
                                                                mimicry_surface_point* out,
                                                                mimicry_answer* answers);

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

/* Geodesics ---------------------------------------------------------------------------------- */

/* In what follows, of a surface point that is given only face and barycentric are read. */

/* A vertex of a path on a surface: an end, or where it crosses an edge. */
typedef struct mimicry_path_point {
  double position[3]; /* model */
  double t;           /* where on the half-edge, 0 to 1 */
  int32_t half_edge;  /* 3 f + k: from corner k of face f to the next; -1 at the path's ends */
  int32_t unused;
} mimicry_path_point;

/* Exact distances on the surface from the nearest of sources. radius: look no farther, model units,
 * > 0; INFINITY for all. O(#F^1.5) in practice, where it can be cancelled. */
MIMICRY_API mimicry_status mimicry_geodesics_create(const mimicry_target* target,
                                                    const mimicry_surface_point* sources,
                                                    size_t count, double radius,
                                                    mimicry_progress progress, void* user,
                                                    mimicry_geodesics** out);
MIMICRY_API void mimicry_geodesics_destroy(mimicry_geodesics* geodesics);
/* 0 on meshes on which the search gave up: distances are upper bounds then. */
MIMICRY_API int32_t mimicry_geodesics_are_exact(const mimicry_geodesics* geodesics);
/* distances: #count, model units; INFINITY where no source reaches a point within the radius. */
MIMICRY_API mimicry_status mimicry_geodesics_distances(const mimicry_geodesics* geodesics,
                                                       const mimicry_surface_point* points,
                                                       size_t count, double* distances);
/* distances: #V, of the mesh's vertices; INFINITY also where no face uses one. */
MIMICRY_API mimicry_status mimicry_geodesics_vertex_distances(const mimicry_geodesics* geodesics,
                                                              double* distances,
                                                              size_t vertex_count);
/* The shortest path from the nearest source (its number, NULL if of no interest) to a point.
 * length: INFINITY, and no path, where no source reaches the point. The path is the object's until
 * the next one. */
MIMICRY_API mimicry_status mimicry_geodesics_find_path(mimicry_geodesics* geodesics,
                                                       const mimicry_surface_point* to,
                                                       double* length, int32_t* source);
MIMICRY_API const mimicry_path_point* mimicry_geodesics_path(const mimicry_geodesics* geodesics);
MIMICRY_API size_t mimicry_geodesics_path_count(const mimicry_geodesics* geodesics);

/* Shortest paths between nearby points in real time, and straightest ones, without preparation of
 * the target, which may move. Allocates nothing for paths no longer than earlier ones. */
MIMICRY_API mimicry_status mimicry_path_finder_create(const mimicry_target* target,
                                                      mimicry_path_finder** out);
MIMICRY_API void mimicry_path_finder_destroy(mimicry_path_finder* finder);
/* length: INFINITY, and no path, where the surface does not join the points. is_shortest (may be
 * NULL): 0 where the path is straight but the search for a shorter one was given up. */
MIMICRY_API mimicry_status mimicry_path_finder_find(mimicry_path_finder* finder,
                                                    const mimicry_surface_point* from,
                                                    const mimicry_surface_point* to, double* length,
                                                    int32_t* is_shortest);
/* Walks straight on over the surface. direction: model, any length; its part along the surface
 * counts. length: model units, at least 0. *walked: less than length where the walk met a boundary,
 * a place where sheets touch, or had no direction. *end, of which distance is the length walked,
 * and *walked may be NULL. */
MIMICRY_API mimicry_status mimicry_path_finder_trace(mimicry_path_finder* finder,
                                                     const mimicry_surface_point* from,
                                                     const double direction[3], double length,
                                                     mimicry_surface_point* end, double* walked);
/* The last path: its vertices from end to end; it lives until the next call. */
MIMICRY_API const mimicry_path_point* mimicry_path_finder_path(const mimicry_path_finder* finder);
MIMICRY_API size_t mimicry_path_finder_path_count(const mimicry_path_finder* finder);

/* The tangent plane at the centre of a patch. */
typedef struct mimicry_tangent_plane {
  double origin[3];
  double x_axis[3]; /* unit, orthogonal to each other and to the normal */
  double y_axis[3];
  double normal[3];
} mimicry_tangent_plane;

/* The discrete exponential map: the surface around a point laid out in its tangent plane. */
MIMICRY_API mimicry_status mimicry_exponential_map_create(const mimicry_target* target,
                                                          mimicry_exponential_map** out);
MIMICRY_API void mimicry_exponential_map_destroy(mimicry_exponential_map* map);
/* radius: model units, > 0; INFINITY for all that is connected. x_hint: direction of the x axis, or
 * NULL for any. plane may be NULL. O(patch log patch). */
MIMICRY_API mimicry_status mimicry_exponential_map_compute(mimicry_exponential_map* map,
                                                           const mimicry_surface_point* centre,
                                                           double radius, const double x_hint[3],
                                                           mimicry_tangent_plane* plane);
/* The patch's vertices, nearest first, and where they lie (#count by 2: length is distance), until
 * the next call. Numbers are the mesh's; of vertices that were joined the lowest stands for all
 * (mimicry_target_surface_sources). */
MIMICRY_API size_t mimicry_exponential_map_count(const mimicry_exponential_map* map);
MIMICRY_API const int32_t* mimicry_exponential_map_vertices(const mimicry_exponential_map* map);
MIMICRY_API const double* mimicry_exponential_map_coordinates(const mimicry_exponential_map* map);

/* Frames ------------------------------------------------------------------------------------- */

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

/* Other programs' coordinates: "openxr", "unity", "unreal", "paper" (formats.md). `in` converts
 * from theirs to those of this header, `out` back; from and to may be the same array. */
MIMICRY_API int32_t mimicry_convention_count(void);
/* NULL where there is no such number. */
MIMICRY_API const char* mimicry_convention(int32_t number);
/* Poses of devices in the world. */
MIMICRY_API mimicry_status mimicry_frames_in(const char* convention, const mimicry_frame* from,
                                             size_t count, mimicry_frame* to);
MIMICRY_API mimicry_status mimicry_frames_out(const char* convention, const mimicry_frame* from,
                                              size_t count, mimicry_frame* to);
/* Where a model stands, whose own axes change like the world's. */
MIMICRY_API mimicry_status mimicry_placement_in(const char* convention,
                                                const mimicry_similarity* from,
                                                mimicry_similarity* to);
MIMICRY_API mimicry_status mimicry_placement_out(const char* convention,
                                                 const mimicry_similarity* from,
                                                 mimicry_similarity* to);
/* Positions in the world, #count by 3: axes and unit of length. */
MIMICRY_API mimicry_status mimicry_positions_in(const char* convention, const double* from,
                                                size_t count, double* to);
MIMICRY_API mimicry_status mimicry_positions_out(const char* convention, const double* from,
                                                 size_t count, double* to);
/* Axes alone, #count by 3: directions, normals, and positions in a model's own units. */
MIMICRY_API mimicry_status mimicry_axes_in(const char* convention, const double* from, size_t count,
                                           double* to);
MIMICRY_API mimicry_status mimicry_axes_out(const char* convention, const double* from,
                                            size_t count, double* to);
/* A mesh whose positions the other program gave, in the axes of this header, units as they were.
 * Of left-handed programs, whose front faces are clockwise, the second and third corner of every
 * face are exchanged; so are barycentric coordinates on it. Its own inverse for `out`. */
MIMICRY_API mimicry_status mimicry_mesh_in(const char* convention, const mimicry_mesh* mesh,
                                           mimicry_mesh** out);
MIMICRY_API mimicry_status mimicry_mesh_out(const char* convention, const mimicry_mesh* mesh,
                                            mimicry_mesh** out);

/* Techniques --------------------------------------------------------------------------------- */

typedef enum mimicry_option_kind MIMICRY_INT {
  MIMICRY_OPTION_BOOLEAN = 0,   /* 0 or 1 */
  MIMICRY_OPTION_NUMBER = 1,    /* lowest to highest */
  MIMICRY_OPTION_DIRECTION = 2, /* three, lowest to highest, not all zero */
  MIMICRY_OPTION_CHOICE = 3     /* the number of one of its choices, from 0 */
} mimicry_option_kind;

typedef struct mimicry_option_info {
  const char* name;
  const char* unit;
  const char* description;
  mimicry_option_kind kind;
  int32_t count; /* of its numbers: 3 of a direction, else 1 */
  int32_t choice_count;
  const char* const* choices; /* names of a choice's values; else NULL */
  double defaults[3];
  double lowest; /* of each number */
  double highest;
} mimicry_option_info;

/* What a technique makes of the controller, and so how people steer with it. */
typedef enum mimicry_steering MIMICRY_INT {
  MIMICRY_AIMED = 0, /* the point is where the controller points: people turn the wrist */
  MIMICRY_MOVED = 1  /* the hand's place or motion counts */
} mimicry_steering;

typedef struct mimicry_technique_info {
  const char* name;
  const char* title;       /* for people */
  const char* sentence;    /* for someone who has never read of it */
  const char* description; /* a line, exact */
  const char* source;      /* section or equation of the paper, "-": none */
  const char* screen_note; /* why a pen on a screen draws little with it; empty where it does not */
  uint32_t color;          /* sRGB, 0xrrggbb, of its curves in documents and pictures */
  mimicry_steering steering;
  int32_t anchored; /* looks at the last point too */
  int32_t needs_bake;
  int32_t rank; /* those of lower rank are offered to people first */
  int32_t option_count;
  const mimicry_option_info* options;
} mimicry_technique_info;

MIMICRY_API int32_t mimicry_technique_count(void);
/* NULL where there is no such number. What it says lives as long as the program. */
MIMICRY_API const mimicry_technique_info* mimicry_technique(int32_t number);

/* A technique of your own. Called once a frame, in the thread that adds the frame; several threads
 * may draw with it at once. target: only for queries, and only during the call. frame: in the
 * target's coordinates and units. metres_per_unit: at which the target is shown. options: the
 * values of all options in their order, 1 number each and 3 of a direction. memory: of memory_size
 * bytes, 0 when a stroke starts; what is written is there in the next frame. Returns how it found a
 * point, of which it sets `face` and `barycentric` (as the queries give them; position, normal and
 * distance are not read), or MIMICRY_NO_POINT. A point off the target counts as none. Should depend
 * on its arguments alone, so that a recorded stroke always gives the same curve. */
typedef mimicry_answer (*mimicry_step_function)(void* user, const mimicry_target* target,
                                                const mimicry_frame* frame, double metres_per_unit,
                                                const double* options, void* memory,
                                                mimicry_surface_point* point);

/* All texts and options are copied. name: lower case letters and digits, words joined by '-'. Of
 * options, `count` is not read. NULL texts are empty, a NULL title is the name. */
typedef struct mimicry_own_technique {
  const char* name;
  const char* title;
  const char* sentence;
  const char* description;
  const mimicry_option_info* options;
  int32_t option_count; /* at most 64 */
  uint32_t color;       /* 0xrrggbb */
  mimicry_steering steering;
  int32_t anchored;
  int32_t needs_bake;
  int32_t rank;
  size_t memory_size; /* at most 1 MiB */
  mimicry_step_function step;
  void* user; /* must stay valid until the program ends */
} mimicry_own_technique;

/* Adds it to the techniques that sessions and files know by name, until the program ends; at most
 * 200. *number, which may be NULL: of mimicry_technique. */
MIMICRY_API mimicry_status mimicry_technique_register(const mimicry_own_technique* technique,
                                                      int32_t* number);

/* Sessions ----------------------------------------------------------------------------------- */

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

/* A copy on the target as it stands now, after mimicry_target_update_positions. */
MIMICRY_API mimicry_status mimicry_curve_follow(const mimicry_curve* curve, mimicry_curve** out);

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

/* Studies ------------------------------------------------------------------------------------ */

/* Curves that people are asked to draw, sampled or read from a file of them. */
typedef struct mimicry_sampling_options {
  double least_k_g; /* geodesic distance between controls, in diagonals */
  double most_k_g;
  double least_k_n_rad; /* angle between the controls' normals */
  double most_k_n_rad;
  int32_t controls;      /* of a curve, at least 4 */
  int32_t points;        /* of a curve, at least 2 */
  int32_t most_attempts; /* for one curve */
  int32_t unused;
} mimicry_sampling_options;

MIMICRY_API mimicry_sampling_options mimicry_default_sampling_options(void); /* the paper's */
/* count: 1 to 1000 curves on a target with its bake. metres_per_unit: > 0, for the keypoints.
 * options: NULL for the defaults. Equal arguments give equal curves. Can be cancelled. */
MIMICRY_API mimicry_status mimicry_target_curves_sample(const mimicry_target* target, size_t count,
                                                        uint32_t seed, double metres_per_unit,
                                                        const mimicry_sampling_options* options,
                                                        mimicry_progress progress, void* user,
                                                        mimicry_target_curves** out);
/* The curves of one shape of a file. shape: its name in the file; NULL where it is the only one. */
MIMICRY_API mimicry_status mimicry_target_curves_read(const void* data, size_t size,
                                                      const char* name, const char* shape,
                                                      mimicry_target_curves** out);
/* A file with the curves of one shape. note: for its readers, may be NULL. */
MIMICRY_API mimicry_status mimicry_target_curves_write(const mimicry_target_curves* curves,
                                                       const char* shape, const char* note,
                                                       mimicry_bytes** out);
MIMICRY_API void mimicry_target_curves_destroy(mimicry_target_curves* curves);
MIMICRY_API double mimicry_target_curves_metres_per_unit(const mimicry_target_curves* curves);
MIMICRY_API size_t mimicry_target_curves_count(const mimicry_target_curves* curves);
/* Of a curve; 0 where there is no such number. */
MIMICRY_API size_t mimicry_target_curves_point_count(const mimicry_target_curves* curves,
                                                     size_t number);
MIMICRY_API size_t mimicry_target_curves_keypoint_count(const mimicry_target_curves* curves,
                                                        size_t number);
/* points: room for all, with position and normal of this target, whose mesh the curves were made
 * on. */
MIMICRY_API mimicry_status mimicry_target_curves_points(const mimicry_target_curves* curves,
                                                        size_t number, const mimicry_target* target,
                                                        mimicry_surface_point* points);
/* Numbers of the curve's points; NULL where there are none. */
MIMICRY_API const int32_t* mimicry_target_curves_keypoints(const mimicry_target_curves* curves,
                                                           size_t number);

/* The points by which a curve is shown when it is to be re-created: ends, bends, long sections.
 * numbers: room for count; *found of them are written, increasing. */
MIMICRY_API mimicry_status mimicry_keypoints(const mimicry_target* target,
                                             const mimicry_surface_point* points, size_t count,
                                             double metres_per_unit, int32_t* numbers,
                                             size_t* found);

/* What is measured of a stroke and its curve against the intended curve X, whose length is L_X.
 * World lengths. */
typedef struct mimicry_measures {
  double d_ep_m;        /* mean distance of corresponding points */
  double d_sym_m;       /* mean closest distance, both ways */
  double k_e_rad_per_m; /* turning in space / L_X */
  double k_g_rad_per_m; /* geodesic curvature, total / L_X */
  double f_g_rad_per_m; /* its change from node to node, total / L_X */
  double t_h;           /* path of the head / L_X */
  double r_h_rad_per_m; /* rotation of the head / L_X */
  double t_c;           /* path of the controller / L_X */
  double r_c_rad_per_m; /* rotation of the controller / L_X */
  double tau_s;         /* duration */
  double mimicry_violation;
  double l_x_m;
  double k_g_normalised_rad_per_m;
  double largest_jump;  /* of the curve by that of the hand, from frame to frame */
  double share_jumping; /* of frames, 0 to 1 */
  double frechet_m;
  double end_lag_m;
  double length_ratio;
  int32_t gaps;
  int32_t boundary_nodes;
  int32_t undefined_nodes;
  int32_t too_short; /* the paper leaves such strokes out: */
  int32_t noisy;
  int32_t inverted;
} mimicry_measures;

/* frames: those that drew the curve, of the target at model_to_world. intended: X, at least two
 * points. keypoints: numbers of its points; none: it is not told whether the curve was drawn the
 * other way round. join_pieces: 1 as in the paper; 0: what joins pieces does not count as curved.
 */
MIMICRY_API mimicry_status mimicry_measure(const mimicry_curve* curve,
                                           const mimicry_similarity* model_to_world,
                                           const mimicry_frame* frames, size_t frame_count,
                                           const mimicry_surface_point* intended,
                                           size_t intended_count, const int32_t* keypoints,
                                           size_t keypoint_count, int32_t join_pieces,
                                           mimicry_measures* out);

typedef enum mimicry_hand_copy MIMICRY_INT {
  MIMICRY_COPY_AUTOMATIC = 0,
  MIMICRY_COPY_TRANSLATED = 1,
  MIMICRY_COPY_OFFSET = 2,
  MIMICRY_COPY_PLACED = 3,
  MIMICRY_COPY_TURNED = 4
} mimicry_hand_copy;

/* What a simulated person does (docs/study.md). */
typedef struct mimicry_simulation_options {
  double rate_hz; /* 20 to 1000 */
  double least_duration_s;
  double most_duration_s;
  double mean_distance_m; /* from hand to target */
  double smoothing_m;
  double drift_m;
  double tremor_m;
  double noise_m;
  double wobble_rad; /* of the controller's aim */
  double start_error_m;
  double turn_tremor_rad;
  double turn_noise_rad;
  double head_distance_m;
  double head_follow;
  double feedback_delay_s; /* of who sees the ink */
  double feedback_gain_per_s;
  mimicry_hand_copy copy; /* of the curve, that the hand follows in the air */
  int32_t unused;
} mimicry_simulation_options;

MIMICRY_API mimicry_simulation_options mimicry_default_simulation_options(void);
/* Appends the stroke of a simulated person who means the curve `intended` (at least two points).
 * technique: whose ink the person sees and corrects; NULL: none's. id: the stroke's; target_name:
 * NULL for the mesh's. options: NULL for the defaults. Equal arguments give equal strokes. About 10
 * ms. */
MIMICRY_API mimicry_status mimicry_strokes_simulate(
    mimicry_strokes* strokes, const mimicry_target* target, const char* technique, const char* id,
    const char* target_name, const mimicry_similarity* model_to_world,
    const mimicry_surface_point* intended, size_t intended_count,
    const mimicry_simulation_options* options, uint32_t seed);

#ifdef __cplusplus
}
#endif

#endif
