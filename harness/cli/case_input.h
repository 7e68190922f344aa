/* The case of a run, built in or a scene file, its parameters, and the truths that belong to it. */
#ifndef BEAMWORK_CASE_INPUT_H
#define BEAMWORK_CASE_INPUT_H

#include "harness/cli/command.h"
#include "harness/study/truths.h"

/* A name that is no built-in case but that of an example (cases/examples/NAME.yaml) becomes --scene
 * of that file. */
void case_input_example(command_request *r);
/* The case of the request with its parameters, or NULL after a message. */
const case_type *case_input_find(command_request *r);
/* Frees what case_input_find has read. */
void case_input_close(command_request *r);
/* The case of --scene FILE, or NULL after messages: all its mistakes. */
const case_type *case_input_scene(command_request *r);
/* Reads one scene file; EXIT_AS_EXPECTED, or an exit code after messages. */
int case_input_read(const command_request *r, const char *path, scene_file **out);
/* Truths of the run: those stored, or, of a scene file, its own at the parameters of the request.
 */
status case_input_truths(const command_request *r, truths *t, fault *f);
/* One line on stderr where the numbers of a scene file look like other units; NULL: none. */
void case_input_tell_units(const scene_file *, const double parameter[]);
/* One line on stderr: which analysis was made up where the scene file states none. */
void case_input_tell_analysis(const command_request *r, const scene *s);
/* The packed truths: --truths, or their place (harness/study/data_place.h). */
const char *case_input_truths_path(const command_request *r);

#endif
