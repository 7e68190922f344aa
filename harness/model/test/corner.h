/* Two members that form a corner, with arms of 1 m and 2 m, clamped at one end, without drives. */
#ifndef BEAMWORK_TEST_CORNER_H
#define BEAMWORK_TEST_CORNER_H

#include <gsl/gsl_test.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

/* Builds the corner. attached 1: adds a node on a rigid arm at the tip. Returns 0 on failure. */
static int corner(const char *formulation_name, int elements, int attached, scene *s, model **m)
{
    const double y[3] = {0, 0, 1}, end = 1;
    const section_spec spec = section_spec_rectangle(1e4, 4e3, 0.2, 0.05);
    fault f = {""};
    scene_init(s, "corner");
    const int root = scene_add_node(s, 0, 0, 0), middle = scene_add_node(s, 1, 0, 0),
              tip = scene_add_node(s, 1, 2, 0), profile = scene_add_section(s, &spec);
    if (attached)
        scene_add_attached(s, tip, 1, 2, 0.3);
    scene_add_member(s, root, middle, profile, y);
    scene_add_member(s, middle, tip, profile, y);
    scene_hold_all(s, root);
    scene_add_static(s, 1, &end, 1);
    const model_request request = {s, formulation_find(formulation_name), NULL, elements, 0, 0};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "a corner: %s", f.text);
    return made == STATUS_OK;
}

#endif
