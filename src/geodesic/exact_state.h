#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <mimicry/geodesic/exact.h>

#include "geodesic/site.h"
#include "geodesic/surface_frames.h"
#include "geodesic/window_lists.h"

namespace mimicry {

/// The best way from a point of a face toward a source, one step of it.
struct Step {
  enum class Kind { none, source, vertex, edge };
  Kind kind = Kind::none;
  double distance = kInfinity;
  Index index = kNone;  ///< number of the source; the vertex; the face's half-edge
  double x = 0.0;       ///< edge: where along the half-edge
};

struct ExactGeodesics::State {
  explicit State(const Surface& on)
      : held(on), mesh(held.mesh()), half_edges(held.half_edges()), surface(mesh, half_edges) {}

  const Surface held;  // keeps alive what the others refer to
  const TriangleMesh& mesh;
  const HalfEdges& half_edges;
  SurfaceFrames surface;

  struct Entry {
    double key;
    Index item;                                 ///< an edge with windows that wait, or -1 - vertex
    bool operator<(const Entry& other) const {  // of a heap with the nearest on top
      return key != other.key ? key > other.key : item > other.item;
    }
  };

  /// The face behind half-edge `entered`, in its frame.
  struct Facet {
    struct Side {
      Index half_edge;
      double length;
      Vec2 tail;
      Vec2 along;  // of length 1
    };
    Index entered;
    double length;
    Vec2 apex;
    Side left;   // apex to tail
    Side right;  // head to apex
  };

  /// What comes in over a facet's edge: all between two rays from a source below the edge.
  struct Fan {
    Vec2 source;
    Vec2 left;
    Vec2 right;
    Index root;
    int depth;
  };

  std::vector<Source> sources;                        // barycentrics normalised
  std::vector<std::pair<Index, Index>> face_sources;  // (face, source), sorted
  WindowLists lists;
  std::vector<Entry> heap;
  std::vector<double> edge_keys;  // #E, of the edge's entry in the heap; kInfinity: it has none
  // Windows made but not yet on their edges: in order on the edges behind the one that is sent on,
  // and others.
  struct Batch {
    Index edge = kNone;
    WindowStack windows;
  };
  std::array<Batch, 2> batches;
  std::vector<std::pair<Index, Window>> strays;
  std::vector<double> distances;         // #V
  std::vector<double> arrival_angles;    // #V, around the vertex, of the way it was reached
  std::vector<Index> arrived_from;       // #V: a vertex along an edge, kThroughFaces, kNone
  std::vector<Index> vertex_sources;     // #V: the source that the vertex is, kNone
  std::vector<std::uint8_t> is_watched;  // #V, a corner of a target's face
  bool watched_changed = false;
  double known = 0.0;  // distances up to here are final
  std::size_t made = 0;
  bool complete = true;

  static constexpr Index kThroughFaces = -2;
  static constexpr Index kIsSource = -3;

  const EdgeFrame& frame(Index h) const { return surface.frames[static_cast<std::size_t>(h)]; }
  double at(Index vertex) const { return distances[static_cast<std::size_t>(vertex)]; }

  void compute(std::span<const Source> new_sources, const ExactOptions& options);
  void start(Index source);
  void push(double key, Index item);
  bool reach_vertex(Index v, double distance, Index from);
  void leave_vertex(Index v);
  void send_on(Index edge);
  Facet facet(Index entered) const;
  void spread(const Facet& facet, const Fan& fan);
  void add_window(Index h, double begin, double end, double x, double y, Index root);
  void merge(Index edge, std::span<const Window> windows);
  void merge_strays();

  /// Position in the frame of half-edge h of a point of its face.
  Vec2 in_frame(Index h, const SurfacePoint& p) const;
  /// The best step from p, which lies in the face: over any edge but `entered`, or to a vertex with
  /// a distance below `below`.
  Step best_step(const SurfacePoint& p, Index entered, double below) const;
  void best_window(Index h, const Vec2& p, Step& best) const;
  double distance_at(const SurfacePoint& p) const;
  ExactPath path_to(const SurfacePoint& p) const;
};

}  // namespace mimicry
