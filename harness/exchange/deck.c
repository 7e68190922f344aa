#include "harness/exchange/deck.h"
#include "cases/scene/names.h"

#include <stdlib.h>

#include "harness/exchange/answers.h"
#include "harness/exchange/carried.h"

status deck_check(const deck_request *r, fault *f)
{
    if (r->elements < 1 || r->elements > DECK_MOST_ELEMENTS)
        return fault_set(f, STATUS_REFUSED, "%d elements along a member: give 1 to %d with -n",
                         r->elements, DECK_MOST_ELEMENTS);
    if (r->scene->plane != SCENE_SPACE)
        return fault_set(
            f, STATUS_REFUSED,
            "scene %.60s is held in a plane, which solids are not: take plane: %s away",
            r->scene->name, scene_plane_name(r->scene));
    TRY(carried_check(r->scene, f));
    return carried_asked_check(r->scene, f);
}

/* Bricks of all members; bodies: the numbers behind the last one. */
static status make_bricks(const deck_request *r, brick out[], body_numbers *bodies, fault *f)
{
    int node = 1, element = 1;
    for (int i = 0; i < r->scene->members; i++) {
        const int own = r->scene->member[i].divisions;
        TRY(brick_init(&out[i], r->scene, i, own > 0 ? own : r->elements, node, element, f));
        node = brick_next_node(&out[i]);
        element = brick_next_element(&out[i]);
    }
    *bodies = (body_numbers){.first = node};
    return STATUS_OK;
}

static void write_deck_head(const deck_request *r, int elements, FILE *to)
{
    fprintf(to,
            "** beamwork: %s as solids with rigid faces, for CalculiX 2.20\n"
            "**CASE %s\n**ELEMENTS %d\n",
            r->scene->name, r->of, elements);
}

/* What a moment does while its node turns: about the undeformed structure, which is all that decks
 * ask with moments, all conventions are the same. */
static void write_convention(const scene *s, FILE *to)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_COMPLIANCE) {
            fprintf(to, "**CONVENTION %s\n",
                    scene_moments_name(scene_compliance_of(&s->analysis[i])->moments));
            return;
        }
}

static void write_material(const scene *s, int member, FILE *to)
{
    const section_spec *profile = &s->section[s->member[member].section];
    fprintf(to,
            "*MATERIAL,NAME=MATERIAL%d\n*ELASTIC\n%.12e,%.12e\n"
            "*SOLID SECTION,ELSET=MEMBER%d,MATERIAL=MATERIAL%d\n",
            member, profile->young, profile->young / (2 * profile->shear_modulus) - 1, member,
            member);
}

static void write_mesh(const scene *s, const brick bricks[], const body_numbers *bodies, FILE *to)
{
    fputs("*NODE,NSET=NODES\n", to);
    for (int i = 0; i < s->members; i++)
        brick_write_nodes(&bricks[i], to);
    body_write_nodes(bodies, s, to);
    for (int i = 0; i < s->members; i++) {
        fprintf(to, "*ELEMENT,TYPE=C3D20R,ELSET=MEMBER%d\n", i);
        brick_write_elements(&bricks[i], to);
        write_material(s, i, to);
    }
    body_write(bodies, s, bricks, to);
}

/* How far the area of each solid is from that of its beam: walls overlap where they meet. */
static status write_areas(const scene *s, const brick bricks[], FILE *to, fault *f)
{
    for (int i = 0; i < s->members; i++) {
        section constants;
        TRY(scene_constants(s, s->member[i].section, &constants, f));
        fprintf(to, "**AREA %s: %+.3g %% of the beam's\n", scene_called(s, SCENE_MEMBERS, i).text,
                100 * (face_area(&bricks[i].face) / constants.A - 1));
    }
    return STATUS_OK;
}

/* bricks: [members], room for them. */
static status write_with(const deck_request *r, brick bricks[], FILE *to, fault *f)
{
    const scene *s = r->scene;
    body_numbers bodies;
    TRY(make_bricks(r, bricks, &bodies, f));
    write_deck_head(r, brick_next_element(&bricks[s->members - 1]) - 1, to);
    write_convention(s, to);
    TRY(write_areas(s, bricks, to, f));
    write_mesh(s, bricks, &bodies, to);
    return answers_write(s, &bodies, to, f);
}

status deck_write(const deck_request *r, FILE *to, fault *f)
{
    const scene *s = r->scene;
    TRY(deck_check(r, f));
    brick *bricks = calloc((size_t)s->members, sizeof *bricks);
    if (bricks == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a mesh of solids");
    const status outcome = write_with(r, bricks, to, f);
    free(bricks);
    return outcome;
}
