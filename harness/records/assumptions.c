#include "harness/records/assumptions.h"

#include <stdio.h>
#include <string.h>

#include "cases/scene/names.h"
#include "cases/scene/omission.h"
#include "harness/model/model.h"

const char *assumptions_kind(int kind)
{
    static const char *const names[] = {
        [ASSUMPTION_NOT_KNOWN] = "not known", [ASSUMPTION_NOT_MODELLED] = "not modelled"};
    return kind >= 0 && kind < ASSUMPTION_KINDS ? names[kind] : "";
}

/* 1: the section has one of that kind. */
static int of_section(const scene *s, assumption *a)
{
    const scene_words name = scene_name(s, SCENE_SECTIONS, a->section);
    a->physics[0] = '\0';
    if (a->kind == ASSUMPTION_NOT_MODELLED) {
        snprintf(a->text, sizeof a->text,
                 "what the bimoment of section %s does to its torsion (int omega r^2 dA, which is "
                 "not zero there): where warping is restrained, twists to either side differ",
                 name.text);
        return features_one_sided(s, a->section);
    }
    scene_omission_words(features_not_given(s, a->section), a->physics);
    snprintf(a->text, sizeof a->text,
             "%s of section %s, whose numbers say nothing of it: taken as zero", a->physics,
             name.text);
    return a->physics[0] != '\0';
}

/* A built-in case has from its source what there is. */
int assumptions_at(const sweep_point *p, int index, assumption *out)
{
    int found = 0;
    if (p->type->file == NULL || p->status != STATUS_OK)
        return 0;
    for (int i = 0; i < p->scene.sections; i++)
        for (int kind = 0; kind < ASSUMPTION_KINDS; kind++) {
            out->section = i;
            out->kind = (assumption_kind)kind;
            if (of_section(&p->scene, out) && found++ == index)
                return 1;
        }
    return 0;
}

void assumptions_words(const sweep_point *p, size_t size, char out[])
{
    const size_t rest = 40; /* for the number of those that find no room */
    size_t used = 0;
    int left = 0;
    assumption a;
    out[0] = '\0';
    for (int i = 0; assumptions_at(p, i, &a); i++) {
        const char *kind = assumptions_kind(a.kind), *between = i > 0 ? "; " : "";
        const size_t more = strlen(between) + strlen(kind) + 2 + strlen(a.text);
        if (left > 0 || used + more + rest > size) {
            left++;
            continue;
        }
        snprintf(out + used, size - used, "%s%s: %s", between, kind, a.text);
        used += more;
    }
    if (left > 0 && size > used)
        snprintf(out + used, size - used, "; and of %d more", left);
}
