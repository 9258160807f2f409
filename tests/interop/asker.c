// SPDX-License-Identifier: Apache-2.0
// Asks a node for its parameters as rmw_cyclonedds does, by that vendor's library, and prints one
// line of JSON.
//   interop_asker DOMAIN NODE SECONDS
#include <dds/dds.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "service.h"

#define CLIENT 0x1122334455667788ull
#define NUMBER 7
typedef rcl_interfaces_srv_dds__ListParameters_Request_ Request;
typedef rcl_interfaces_srv_dds__ListParameters_Response_ Response;

static dds_qos_t *service_qos(void) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  return qos;
}

static dds_entity_t topic_of(dds_entity_t p, const dds_topic_descriptor_t *type, const char *kind,
                             const char *node, const char *tail) {
  char name[256];
  snprintf(name, sizeof name, "%s/%s/list_parameters%s", kind, node, tail);
  return dds_create_topic(p, type, name, NULL, NULL);
}

// The server's reader and writer are both there.
static bool matched(dds_entity_t writer, dds_entity_t reader, dds_instance_handle_t *server) {
  dds_instance_handle_t of_request;
  return dds_get_matched_subscriptions(writer, &of_request, 1) == 1 &&
         dds_get_matched_publications(reader, server, 1) == 1;
}

static void print_told(dds_entity_t reader, dds_instance_handle_t server) {
  dds_builtintopic_endpoint_t *endpoint = dds_get_matched_publication_data(reader, server);
  void *told = NULL;
  size_t size = 0;
  if (endpoint != NULL && dds_qget_userdata(endpoint->qos, &told, &size) && told != NULL)
    printf("\"told\": \"%.*s\", ", (int)size, (char *)told);
  dds_free(told);
  if (endpoint != NULL) dds_builtintopic_free_endpoint(endpoint);
}

static bool print_reply(dds_entity_t reader) {
  void *sample = NULL;
  dds_sample_info_t info;
  if (dds_take(reader, &sample, &info, 1, 1) != 1) return false;
  const Response *reply = sample;
  const bool ours = info.valid_data && reply->client == CLIENT && reply->number == NUMBER;
  if (ours) {
    printf("\"names\": [");
    for (uint32_t i = 0; i < reply->names._length; ++i)
      printf("%s\"%s\"", i > 0 ? ", " : "", reply->names._buffer[i]);
    printf("], ");
  }
  dds_return_loan(reader, &sample, 1);
  return ours;
}

int main(int argc, char **argv) {
  if (argc != 4) return 2;
  dds_entity_t p = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (p < 0) return 2;
  dds_qos_t *qos = service_qos();
  dds_entity_t writer = dds_create_writer(
      p, topic_of(p, &rcl_interfaces_srv_dds__ListParameters_Request__desc, "rq", argv[2], "Request"),
      qos, NULL);
  dds_entity_t reader = dds_create_reader(
      p, topic_of(p, &rcl_interfaces_srv_dds__ListParameters_Response__desc, "rr", argv[2], "Reply"),
      qos, NULL);
  dds_delete_qos(qos);
  const dds_time_t end = dds_time() + DDS_SECS(atoi(argv[3]));
  dds_instance_handle_t server = 0;
  while (!matched(writer, reader, &server) && dds_time() < end) dds_sleepfor(DDS_MSECS(20));
  Request request;
  memset(&request, 0, sizeof request);
  request.client = CLIENT;
  request.number = NUMBER;
  const dds_time_t asked = dds_time();
  dds_write(writer, &request);
  printf("{");
  print_told(reader, server);
  bool done = false;
  while (!(done = print_reply(reader)) && dds_time() < end) dds_sleepfor(DDS_MSECS(1));
  if (!done) printf("\"names\": null, ");
  printf("\"ms\": %.1f}\n", (double)(dds_time() - asked) / 1e6);
  dds_delete(p);
  return done ? 0 : 1;
}
