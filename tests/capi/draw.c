/* A C program that draws a stroke on a sphere; returns the line that failed, 0 for none. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <mimicry/mimicry.h>

#define CHECK(condition)                                                                  \
  do {                                                                                    \
    if (!(condition)) {                                                                   \
      fprintf(stderr, "draw.c:%d: %s: %s\n", __LINE__, #condition, mimicry_last_error()); \
      return __LINE__;                                                                    \
    }                                                                                     \
  } while (0)

int draw_in_c(void);

int draw_in_c(void) {
  mimicry_mesh* mesh = NULL;
  mimicry_target* target = NULL;
  mimicry_session* session = NULL;
  mimicry_curve* curve = NULL;
  mimicry_tube* tube = NULL;
  mimicry_bytes* file = NULL;
  const mimicry_similarity here = {{0, 0, 0, 1}, {0, 0, 0}, 1.0};
  const double nozzle[3] = {0, 0, -1};
  int i;

  CHECK(mimicry_abi_version() == MIMICRY_ABI_VERSION);
  CHECK(mimicry_mesh_shape("sphere", 16, &mesh) == MIMICRY_OK);
  CHECK(mimicry_mesh_face_count(mesh) == 20 * 16 * 16);
  CHECK(mimicry_target_create(mesh, 0, &target) == MIMICRY_OK);
  mimicry_mesh_destroy(mesh); /* the target has its own */
  CHECK(mimicry_session_create(target, "anchored-closest", &session) == MIMICRY_OK);
  CHECK(mimicry_session_set_option(session, "nozzle", nozzle, 3) == MIMICRY_OK);
  CHECK(mimicry_session_begin(session, &here) == MIMICRY_OK);
  for (i = 0; i < 90; ++i) {
    mimicry_frame frame;
    mimicry_frame_status status = MIMICRY_FRAME_REJECTED;
    memset(&frame, 0, sizeof frame);
    frame.time_s = i / 90.0;
    frame.head_orientation[3] = frame.controller_orientation[3] = 1;
    frame.controller_position[0] = 0.005 * i;
    frame.controller_position[2] = 1.2;
    frame.trigger = 1;
    frame.pressure = -1;
    CHECK(mimicry_session_add(session, &frame, &status) == MIMICRY_OK);
    CHECK(status == MIMICRY_FRAME_INKED);
  }
  CHECK(mimicry_session_end(session) == MIMICRY_OK);
  CHECK(mimicry_session_ink_count(session) > 90);
  CHECK(mimicry_session_ink(session)[0].starts == 1);
  CHECK(mimicry_session_curve(session, &curve) == MIMICRY_OK);
  mimicry_session_destroy(session);
  CHECK(mimicry_curve_point_count(curve) == 90);
  CHECK(fabs(mimicry_curve_length(curve) - 0.4) < 0.05);
  CHECK(mimicry_curve_tube(curve, 0.01, 8, 0.0, &tube) == MIMICRY_OK);
  CHECK(mimicry_tube_face_count(tube) > 0);
  CHECK(mimicry_curves_write(target, "sphere", (const mimicry_curve* const*)&curve, 1,
                             MIMICRY_CURVES_JSON, NULL, 0.01, &file) == MIMICRY_OK);
  mimicry_target_destroy(target); /* the curve keeps what it needs */
  CHECK(mimicry_bytes_size(file) > 1000);
  mimicry_tube_destroy(tube);
  mimicry_curve_destroy(curve);
  mimicry_bytes_destroy(file);
  return 0;
}
