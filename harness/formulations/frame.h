/* A request about many elements, and the numbers in it and in its answer. */
#ifndef BEAMWORK_FRAME_H
#define BEAMWORK_FRAME_H

#include "harness/formulations/process_impl.h"

/* A request about elements. */
typedef struct frame_question {
    enum channel_request what;
    int mask, count;
    const element_data *const *data;
    size_t answer; /* bytes for each element */
} frame_question;

channel *frame_channel(const frame_question *);
int frame_nodes(const element_data *);
/* Parts first, first + most, ...: how many elements of `each` bytes fit into a request. */
int frame_fitting(size_t each);
/* Room behind the kinds of the elements for `each` bytes of every one. FAULT: the process does not
 * know these elements any more. */
status frame_begin(const frame_question *, size_t each, char **to, fault *f);
/* Numbers behind each other: into a request, out of an answer. */
void frame_put(char **to, const void *from, size_t bytes);
void frame_take(const char **from, double to[], size_t count);
/* *body: the answers. */
status frame_ask(const frame_question *, const char **body, fault *f);

#endif
