/* The same technique in C: a function, a structure that it remembers from frame to frame, and a
 * row. Other languages give a callback of theirs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <mimicry/mimicry.h>

/* Of a stroke; zeros when it starts. */
typedef struct steady_memory {
  double time_s;
  double pen[3];
  int32_t has_begun;
  int32_t face; /* where to search first, plus 1 */
} steady_memory;

static mimicry_answer steady_snap(void* user, const mimicry_target* target,
                                  const mimicry_frame* frame, double metres_per_unit,
                                  const double* options, void* memory,
                                  mimicry_surface_point* point) {
  steady_memory* m = memory;
  const double tau_s = options[0];
  const int pause = options[1] != 0;
  const int starts_at_head = options[2] == 1;
  const double follow = m->has_begun ? 1 - exp((m->time_s - frame->time_s) / tau_s) : 1;
  const double* to =
      m->has_begun || !starts_at_head ? frame->controller_position : frame->head_position;
  int k;
  (void)user;
  (void)metres_per_unit;
  for (k = 0; k < 3; ++k) m->pen[k] += follow * (to[k] - m->pen[k]);
  m->has_begun = 1;
  m->time_s = frame->time_s;
  if (pause && frame->trigger < 0.5) return MIMICRY_NO_POINT;
  if (mimicry_target_closest_point(target, m->pen, INFINITY, m->face - 1, point) != MIMICRY_OK ||
      point->face < 0)
    return MIMICRY_NO_POINT;
  m->face = point->face + 1;
  return MIMICRY_CLOSEST;
}

int main(void) {
  static const char* const starts[] = {"hand", "head"};
  mimicry_option_info options[3];
  mimicry_own_technique row;
  mimicry_mesh* mesh = NULL;
  mimicry_target* target = NULL;
  mimicry_session* session = NULL;
  mimicry_curve* curve = NULL;
  const mimicry_similarity here = {{0, 0, 0, 1}, {0, 0, 0}, 1.0};
  const double tau_s = 0.2;
  mimicry_frame frames[90];
  int i, failed;

  memset(options, 0, sizeof options);
  options[0].name = "tau";
  options[0].unit = "s";
  options[0].kind = MIMICRY_OPTION_NUMBER;
  options[0].defaults[0] = 0.1;
  options[0].lowest = 0.001;
  options[0].highest = 2;
  options[1].name = "pause";
  options[1].kind = MIMICRY_OPTION_BOOLEAN;
  options[2].name = "start";
  options[2].kind = MIMICRY_OPTION_CHOICE;
  options[2].choices = starts;
  options[2].choice_count = 2;

  memset(&row, 0, sizeof row);
  row.name = "steady-snap";
  row.title = "Steady snap";
  row.sentence = "Draws at the closest point to a pen that follows your hand calmly.";
  row.description = "to the closest point of the surface from the smoothed pen";
  row.options = options;
  row.option_count = 3;
  row.color = 0x8a3ffc;
  row.steering = MIMICRY_MOVED;
  row.memory_size = sizeof(steady_memory);
  row.step = steady_snap;

  memset(frames, 0, sizeof frames);
  for (i = 0; i < 90; ++i) {
    frames[i].time_s = i / 90.0;
    frames[i].head_orientation[3] = frames[i].controller_orientation[3] = 1;
    frames[i].controller_position[0] = 0.01 * i - 0.4;
    frames[i].controller_position[1] = 0.02 * (i % 2);
    frames[i].controller_position[2] = 1.1;
    frames[i].trigger = 1;
    frames[i].pressure = -1;
  }

  failed = mimicry_technique_register(&row, NULL) || mimicry_mesh_shape("sphere", 0, &mesh) ||
           mimicry_target_make(mesh, NULL, &target) ||
           mimicry_session_create(target, "steady-snap", &session) ||
           mimicry_session_set_option(session, "tau", &tau_s, 1) ||
           mimicry_session_project(session, &here, frames, 90, &curve);
  if (failed)
    fprintf(stderr, "%s\n", mimicry_last_error());
  else
    printf("steady-snap: %d points, %.3f long\n", (int)mimicry_curve_point_count(curve),
           mimicry_curve_length(curve));
  mimicry_curve_destroy(curve);
  mimicry_session_destroy(session);
  mimicry_target_destroy(target);
  mimicry_mesh_destroy(mesh);
  return failed;
}
