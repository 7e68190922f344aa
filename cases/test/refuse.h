/* Scenes that must be rejected. Each is a valid scene with one change. */
#ifndef BEAMWORK_TEST_REFUSE_H
#define BEAMWORK_TEST_REFUSE_H

#include <gsl/gsl_test.h>
#include <string.h>

#include "cases/scene/scene.h"

enum { ROOT, TIP, BODY };

static const double y_axis[3] = {0, 1, 0};

static inline void refuse_unchanged(scene *s)
{
    const double station[2] = {0, 1};
    section_spec spec;
    section_spec_init(&spec);
    scene_init(s, "sound");
    scene_add_node(s, 0, 0, 0);
    scene_add_node(s, 1, 0, 0);
    scene_add_attached(s, TIP, 1, 0.1, 0);
    scene_add_member(s, ROOT, TIP, scene_add_section(s, &spec), y_axis);
    scene_hold_all(s, ROOT);
    scene_drive(s, TIP, SCENE_UY, scene_add_driver(s, "push", 2, station, station));
    scene_add_load(s, SCENE_FORCE, TIP, 1, 0, 0);
    const int path = scene_add_static(s, 2, station, 1);
    scene_add_quantity(s, "u", "m", path, scene_coordinate(TIP, SCENE_UX));
}

typedef void corrupt(scene *);

typedef struct refusal {
    corrupt *how;
    const char *reported_name, *words; /* start of the message, and words in the message */
} refusal;

static inline void refuse_one_line(const char *what, const fault *f)
{
    gsl_test(f->text[0] == '\0' || strchr(f->text, '\n') != NULL, "%s: one line: %s", what,
             f->text);
    gsl_test(strchr(f->text, ';') == NULL, "%s: says what to do: %s", what, f->text);
}

static inline void refuse_scene(const refusal *r)
{
    scene s;
    fault f = {""};
    refuse_unchanged(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "the scene is sound: %s", f.text);
    r->how(&s);
    gsl_test_int((int)scene_validate(&s, &f), STATUS_REFUSED, "refused: %s", r->words);
    gsl_test(strncmp(f.text, r->reported_name, strlen(r->reported_name)) != 0, "%s is named: %s",
             r->reported_name, f.text);
    gsl_test(strstr(f.text, r->words) == NULL, "%s: %s", r->words, f.text);
    refuse_one_line(r->words, &f);
    scene_free(&s);
}

static inline void refuse_all(size_t count, const refusal all[])
{
    for (size_t i = 0; i < count; i++)
        refuse_scene(&all[i]);
}

#endif
