/* The case of a run, built in or a scene file, its parameters, and the truths that belong to it. */
#ifndef BEAMWORK_CASE_INPUT_H
#define BEAMWORK_CASE_INPUT_H

#include "cases/format/scene_file.h"
#include "harness/cli/options.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

typedef struct truths_options {
    const char *packed; /* --truths FILE; NULL: not given */
    text_list own;      /* --truths FILE.csv */
} truths_options;
extern const option_group options_truths;     /* --truths FILE */
extern const option_group options_own_truths; /* FILE.csv as well */

/* The packed truths: --truths, or their place (harness/study/study.h). */
const char *own_tables_packed(const truths_options *);
/* Adds the truths of --truths FILE.csv, of one case where only is not NULL. run: the cases of the
 * run, NULL behind the last. REFUSED: the first mistake, as file:line:column, and how many there
 * are. */
status own_tables_truths(const truths_options *, const case_type *const run[],
                         const case_type *only, truths *t, fault *f);
/* Adds the rules of tables; where there is such a table, new formulations gate. */
status own_tables_findings(const text_list *tables, const case_type *const run[], truths *t,
                           fault *f);

typedef struct case_options {
    const char *name;                      /* the argument; NULL: none */
    const char *scene_path;                /* --scene: in its place */
    text_list set;                         /* NAME=VALUE */
    double parameter[CASE_MAX_PARAMETERS]; /* ... from case_input_find on */
    scene_file *scene;                     /* what was read from scene_path */
    int refusal;                           /* exit code where there is no case */
    command_line *line;
} case_options;
extern const option_group options_case;  /* --scene, --set */
extern const option_group options_scene; /* --scene alone */

/* A name that is no built-in case but that of an example (cases/examples/NAME.yaml) becomes --scene
 * of that file. */
void case_input_example(case_options *);
/* The case of the request with its parameters, or NULL after a message. */
const case_type *case_input_find(case_options *);
/* The case of --scene FILE, or NULL after messages: all its mistakes. */
const case_type *case_input_scene(case_options *);
/* Reads one scene file; EXIT_AS_EXPECTED, or an exit code after messages. */
int case_input_read(const command_line *, const char *path, scene_file **out);
/* Truths of the run: those stored, or, of a scene file, its own at the parameters of the request.
 */
status case_input_truths(const case_options *, const truths_options *, truths *t, fault *f);
/* One line on stderr where the numbers of a scene file look like other units; NULL: none. */
void case_input_tell_units(const scene_file *, const double parameter[]);
/* One line on stderr: which analysis was made up where the scene file states none. */
void case_input_tell_analysis(const case_options *, const scene *s);

enum { SCENES_MOST = 64 };

typedef struct scenes_options {
    text_list scene; /* files, folders */
    int built_in;    /* 1: the built-in cases beside them */
    truths_options truths;
    text_list findings; /* tables beside the ledger */
} scenes_options;

typedef struct scenes {
    int count;
    char *path[SCENES_MOST]; /* [count] of each file, folders looked into */
    scene_file *file[SCENES_MOST];
    const case_type *type[2 * SCENES_MOST + 1]; /* the built-in ones too where they are wanted */
} scenes;

/* All that --scene names: files, and of a folder every *.yaml in the order of their names; type
 * ends in NULL. Not EXIT_AS_EXPECTED: an exit code, after messages; no two are of one name. */
int scenes_read(const command_line *, const scenes_options *, scenes *out);
void scenes_free(scenes *);
/* The built-in truths where those cases are wanted, the ledger, the truths of each file, and the
 * tables of your own project. */
status scenes_truths(const scenes *, const scenes_options *, truths *t, fault *f);

/* For one minor version: one line where ends of members hold their warping because of their
 * supports, were free before, and the answers of this formulation depend on it, as far as two
 * elements for each member tell. Of built-in cases: none. */
void supports_told(const scene_file *, const double parameter[], const formulation *,
                   const scene *);

#endif
