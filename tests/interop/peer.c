// SPDX-License-Identifier: Apache-2.0
// A foreign DDS participant, by another vendor's library: hears the stages' topics and says where a
// person is. Prints one line of JSON and ends when it has heard enough, or time is up.
//   interop_peer DOMAIN VEHICLE SECONDS listen          until all four topics were heard 10 times
//   interop_peer DOMAIN VEHICLE SECONDS observe X Y Z   until target/state says "tracking" near there
// Or stands in the way:
//   interop_peer DOMAIN VEHICLE SECONDS unreliable      a writer of target/state, best effort
//   interop_peer DOMAIN VEHICLE SECONDS foreign         a writer of target/state, of another type
#include <dds/dds.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "foretrack_msgs/msg/PlannedTrajectory.h"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetObservation.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "foretrack_msgs/msg/TargetState.h"

#define WANTED 10
#define NEAR_M 0.3
typedef foretrack_msgs_msg_dds__TargetObservation_ Observation;
typedef foretrack_msgs_msg_dds__TargetState_ State;
typedef foretrack_msgs_msg_dds__TargetIntention_ Intention;
typedef foretrack_msgs_msg_dds__TargetPrediction_ Prediction;
typedef foretrack_msgs_msg_dds__PlannedTrajectory_ Plan;

struct heard {
  int states, intentions, predictions, plans;
  int insane;  // samples whose fields make no sense: a layout that differs
  State state;
};

static dds_entity_t topic_of(dds_entity_t participant, const dds_topic_descriptor_t *type,
                             const char *vehicle, const char *name) {
  char full[128];
  snprintf(full, sizeof full, "rt/%s/%s", vehicle, name);
  dds_entity_t topic = dds_create_topic(participant, type, full, NULL, NULL);
  if (topic < 0) {
    fprintf(stderr, "%s: %s\n", full, dds_strretcode(-topic));
    exit(2);
  }
  return topic;
}

static dds_entity_t reader_of(dds_entity_t participant, dds_entity_t topic) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 5);
  dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

static dds_entity_t writer_of(dds_entity_t participant, dds_entity_t topic) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return writer;
}

// The next sample, or NULL. It is lent: give it back with dds_return_loan.
static void *take(dds_entity_t reader) {
  void *sample = NULL;
  dds_sample_info_t info;
  if (dds_take(reader, &sample, &info, 1, 1) != 1) return NULL;
  if (info.valid_data) return sample;
  dds_return_loan(reader, &sample, 1);
  return NULL;
}

static bool is_sane(double value) { return isfinite(value) && fabs(value) < 1e4; }

static void hear_state(dds_entity_t reader, struct heard *heard) {
  State *s;
  while ((s = take(reader)) != NULL) {
    ++heard->states;
    if (s->status > 3 || strcmp(s->header.frame_id, "map") != 0 || !is_sane(s->position_m[0]) ||
        !is_sane(s->velocity_mps[1]) || !is_sane(s->covariance[35]))
      ++heard->insane;
    heard->state = *s;
    heard->state.header.frame_id = NULL;
    dds_return_loan(reader, (void **)&s, 1);
  }
}

static void hear_intention(dds_entity_t reader, struct heard *heard) {
  Intention *s;
  while ((s = take(reader)) != NULL) {
    ++heard->intentions;
    double sum = 0.0;
    for (uint32_t i = 0; i < s->intentions._length; ++i) sum += s->intentions._buffer[i].probability;
    if (s->intentions._length > 0 && fabs(sum - 1.0) > 1e-3) ++heard->insane;
    dds_return_loan(reader, (void **)&s, 1);
  }
}

static void hear_prediction(dds_entity_t reader, struct heard *heard) {
  Prediction *s;
  while ((s = take(reader)) != NULL) {
    ++heard->predictions;
    for (uint32_t i = 0; i < s->paths._length; ++i) {
      const foretrack_msgs_msg_dds__PredictedPath_ *path = &s->paths._buffer[i];
      if (!(path->probability >= 0.0 && path->probability <= 1.0 + 1e-6)) ++heard->insane;
      for (uint32_t k = 0; k < path->states._length; ++k)
        if (!is_sane(path->states._buffer[k].position_m[0])) ++heard->insane;
    }
    dds_return_loan(reader, (void **)&s, 1);
  }
}

static void hear_plan(dds_entity_t reader, struct heard *heard) {
  Plan *s;
  while ((s = take(reader)) != NULL) {
    ++heard->plans;
    if (s->status > 4 || !is_sane(s->tail_start_s)) ++heard->insane;
    for (uint32_t i = 0; i < s->pieces._length; ++i) {
      const foretrack_msgs_msg_dds__TrajectoryPiece_ *piece = &s->pieces._buffer[i];
      if (!(piece->duration_s > 0.0) || !is_sane(piece->coefficients[0][2])) ++heard->insane;
    }
    dds_return_loan(reader, (void **)&s, 1);
  }
}

static void observe(dds_entity_t writer, const double position_m[3]) {
  Observation o;
  memset(&o, 0, sizeof o);
  const dds_time_t now = dds_time();
  o.header.stamp.sec = (int32_t)(now / DDS_NSECS_IN_SEC);
  o.header.stamp.nanosec = (uint32_t)(now % DDS_NSECS_IN_SEC);
  o.header.frame_id = "map";
  o.kind = foretrack_msgs_msg_dds__TargetObservation_Constants_KIND_POSITION;
  o.camera.width_px = 640;
  o.camera.height_px = 480;
  o.camera.fx_px = o.camera.fy_px = 400.0;
  o.camera.cx_px = 320.0;
  o.camera.cy_px = 240.0;
  o.camera.pose_body.orientation.w = 1.0;
  for (int i = 0; i < 3; ++i) {
    o.position_m[i] = position_m[i];
    o.position_covariance_m2[4 * i] = 0.01;
  }
  o.body_yaw_variance_rad2 = -1.0;
  dds_write(writer, &o);
}

static int stand_in_the_way(dds_entity_t participant, char **argv) {
  const dds_topic_descriptor_t *type = strcmp(argv[4], "foreign") == 0
                                           ? &foretrack_msgs_msg_dds__TargetIntention__desc
                                           : &foretrack_msgs_msg_dds__TargetState__desc;
  writer_of(participant, topic_of(participant, type, argv[2], "target/state"));
  dds_sleepfor(DDS_SECS(atoi(argv[3])));
  dds_delete(participant);
  return 0;
}

int main(int argc, char **argv) {
  if (argc != 5 && argc != 8) {
    fprintf(stderr, "interop_peer DOMAIN VEHICLE SECONDS listen | observe X Y Z | unreliable | "
                    "foreign\n");
    return 2;
  }
  const char *vehicle = argv[2];
  const bool observes = argc == 8;
  const double wanted_m[3] = {observes ? atof(argv[5]) : 0, observes ? atof(argv[6]) : 0,
                              observes ? atof(argv[7]) : 0};
  dds_entity_t p = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (p < 0) return 2;
  if (!observes && strcmp(argv[4], "listen") != 0) return stand_in_the_way(p, argv);
  dds_entity_t states =
      reader_of(p, topic_of(p, &foretrack_msgs_msg_dds__TargetState__desc, vehicle, "target/state"));
  dds_entity_t intentions = reader_of(
      p, topic_of(p, &foretrack_msgs_msg_dds__TargetIntention__desc, vehicle, "target/intention"));
  dds_entity_t predictions = reader_of(
      p, topic_of(p, &foretrack_msgs_msg_dds__TargetPrediction__desc, vehicle, "target/prediction"));
  dds_entity_t plans = reader_of(
      p, topic_of(p, &foretrack_msgs_msg_dds__PlannedTrajectory__desc, vehicle, "plan/trajectory"));
  dds_entity_t writer = 0;
  if (observes)
    writer = writer_of(p, topic_of(p, &foretrack_msgs_msg_dds__TargetObservation__desc, vehicle,
                                   "target/observation"));

  struct heard heard = {0};
  bool done = false;
  const dds_time_t end = dds_time() + DDS_SECS(atoi(argv[3]));
  while (!done && dds_time() < end) {
    if (observes) observe(writer, wanted_m);
    dds_sleepfor(DDS_MSECS(50));
    hear_state(states, &heard);
    hear_intention(intentions, &heard);
    hear_prediction(predictions, &heard);
    hear_plan(plans, &heard);
    const double dx = heard.state.position_m[0] - wanted_m[0];
    const double dy = heard.state.position_m[1] - wanted_m[1];
    const bool tracks = heard.states > 0 && heard.state.status == 1 && hypot(dx, dy) < NEAR_M;
    done = observes ? tracks
                    : heard.states >= WANTED && heard.intentions >= WANTED &&
                          heard.predictions >= WANTED && heard.plans >= WANTED;
  }
  printf("{\"done\": %s, \"states\": %d, \"intentions\": %d, \"predictions\": %d, \"plans\": %d, "
         "\"insane\": %d, \"status\": %d, \"position_m\": [%g, %g, %g]}\n",
         done ? "true" : "false", heard.states, heard.intentions, heard.predictions, heard.plans,
         heard.insane, heard.state.status, heard.state.position_m[0], heard.state.position_m[1],
         heard.state.position_m[2]);
  dds_delete(p);
  return done && heard.insane == 0 ? 0 : 1;
}
