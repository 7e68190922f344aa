/* Members of a scene and what moves it. */
#include <stdio.h>
#include <string.h>

#include "cases/format/builder.h"
#include "cases/format/range.h"
#include "elements/section/taper.h"

static int share(const fields *f, const document_node *name)
{
    builder *b = f->b;
    if (name->kind != DOCUMENT_TEXT) {
        document_mistake(b->mistakes, name, 0, "shared: a name is expected");
        return SCENE_WARP_FREE;
    }
    /* of an instance: its own */
    char full[200];
    const int length = snprintf(full, sizeof full, "%.90s.%.90s",
                                f->placed != NULL ? f->placed->name : "", name->text);
    for (int i = 0; i < b->shares; i++)
        if (strcmp(b->shared[i], full) == 0)
            return i;
    b->shared = arena_grow(b->arena, b->shared, b->shares, sizeof *b->shared);
    const char *kept = arena_copy(b->arena, full, (size_t)length);
    if (b->shared == NULL || kept == NULL) {
        b->shares = 0;
        return SCENE_WARP_FREE;
    }
    b->shared[b->shares] = kept;
    return b->shares++;
}

static int warping_of(const fields *f, const document_node *n)
{
    const document_node *shared = document_find(n, "shared");
    if (shared != NULL && n->count == 1)
        return share(f, shared);
    return fields_word_of(f, n, "warping", "free|fixed", 0) == 0 ? SCENE_WARP_FREE
                                                                 : SCENE_WARP_FIXED;
}

static void read_warping(const fields *f, scene_member *m)
{
    const document_node *n = document_find(f->map, "warping");
    if (n == NULL) {
        m->warp_p = m->warp_q = f->b->unsaid_warping;
        return;
    }
    if (n->kind == DOCUMENT_LIST && n->count != 2) {
        document_mistake(f->b->mistakes, n, 0, "warping: one value, or [at from, at to]");
        return;
    }
    m->warp_p = warping_of(f, n->kind == DOCUMENT_LIST ? n->item[0] : n);
    m->warp_q = warping_of(f, n->kind == DOCUMENT_LIST ? n->item[1] : n);
}

/* What changes along the member can. */
static void check_taper(const fields *f, const document_node *n, const int profile[2])
{
    const scene *s = f->b->scene;
    section c[2];
    const section *const ends[2] = {&c[0], &c[1]};
    fault why = {""};
    for (int k = 0; k < 2; k++)
        if (profile[k] < 0 || profile[k] >= s->sections ||
            scene_constants(s, profile[k], &c[k], NULL) != STATUS_OK)
            return; /* it is told already */
    if (profile[0] != profile[1] &&
        section_taper_check(&s->section[profile[0]], &s->section[profile[1]], ends, &why) !=
            STATUS_OK)
        document_mistake(f->b->mistakes, n, 0, "%s", why.text);
}

/* One name, or [at from, at to]. */
static void read_sections(const fields *f, scene_member *m)
{
    const document_node *n = document_find(f->map, "section");
    if (n->kind != DOCUMENT_LIST) {
        m->section = m->section_q = fields_entry_of(f, n, SCENE_SECTIONS);
        return;
    }
    if (n->count != 2) {
        document_mistake(f->b->mistakes, n, 0,
                         "section: the name of one, or [at from, at to] of two");
        return;
    }
    m->section = fields_entry_of(f, n->item[0], SCENE_SECTIONS);
    m->section_q = fields_entry_of(f, n->item[1], SCENE_SECTIONS);
    check_taper(f, n, (const int[]){m->section, m->section_q});
}

/* One word or a list of them, in their order. */
static void read_released(const fields *f, const char *key, int member, int end)
{
    const document_node *n = document_find(f->map, key);
    unsigned told = 0;
    if (n == NULL)
        return;
    const int count = n->kind == DOCUMENT_LIST ? n->count : 1;
    for (int i = 0; i < count; i++) {
        const document_node *word = n->kind == DOCUMENT_LIST ? n->item[i] : n;
        const int c = fields_word_of(f, word, "release", fields_components, -1);
        if (c >= 0 && told >> c & 1u)
            document_mistake(f->b->mistakes, word, 0, "release: '%s' twice at this end; remove one",
                             word->text);
        else if (c >= 0)
            scene_release_end(f->b->scene, member, end, c);
        told |= c >= 0 ? 1u << c : 0;
    }
}

void builder_members(builder *b)
{
    for (int i = 0; i < b->list[SCENE_MEMBERS].count; i++) {
        const fields f = fields_of(b, &b->list[SCENE_MEMBERS].entry[i]);
        const fields release = fields_below(&f, "release");
        const int index = scene_add_member(b->scene, SCENE_NONE, SCENE_NONE, SCENE_NONE,
                                           (const double[3]){0, 0, 0});
        scene_member *m = scene_member_at(b->scene, index);
        builder_call(b, SCENE_MEMBERS, index, i);
        fields_read(&f, entry_member, m);
        read_sections(&f, m);
        read_warping(&f, m);
        read_released(&release, "from", index, 0);
        read_released(&release, "to", index, 1);
    }
}

/* What a motion moves has its unit. */
static void check_unit(const fields *f, int motion)
{
    const document_node *given = document_find(f->map, "unit");
    const unit_system *units = &f->b->units;
    const int own = units->given && strcmp(given->text, units->name_of_length) == 0;
    const int angle = own ? 0 : fields_word(f, "unit", "m|rad", -1);
    if (angle == 0 && units->given && !own)
        document_mistake(f->b->mistakes, given, 0,
                         "unit 'm': lengths of this scene are in %s; write that, or remove it",
                         units->name_of_length);
    const scene *s = f->b->scene;
    int angles = 0, lengths = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++) {
            lengths += s->node[i].translation[k] == motion;
            angles += s->node[i].angle[k] == motion;
        }
    if ((angle == 1 && lengths > 0) || (angle == 0 && angles > 0))
        document_mistake(f->b->mistakes, document_find(f->map, "unit"), 0,
                         "the motion drives %s; write unit: %s, or drive something else",
                         angle == 1 ? "a translation" : "an angle", angle == 1 ? "m" : "rad");
}

/* Known along a path, in time, in both, or unknown. */
static void check_given(const fields *f)
{
    const int known = fields_have(f, "value") || builder_has_function(f),
              unknown = fields_have(f, "such_that");
    if (known == unknown)
        document_mistake(f->b->mistakes, f->place, 0,
                         known ? "the motion has values and is unknown; remove one"
                               : "the motion needs 'path' and 'value', one of 'time', 'pieces' and "
                                 "'table', or 'such_that'");
}

void builder_motions(builder *b)
{
    for (int i = 0; i < b->list[SCENE_DRIVERS].count; i++) {
        const unrolled *entry = &b->list[SCENE_DRIVERS].entry[i];
        const fields f = fields_of(b, entry), condition = fields_below(&f, "such_that");
        double *path, *value;
        if (fields_have(&f, "unit"))
            check_unit(&f, i);
        if (condition.map == NULL) {
            const int stations = builder_stations(&f, "value", &path, &value);
            const int driver = fields_have(&f, "value")
                                   ? scene_add_driver(b->scene, entry->name, stations, path, value)
                                   : scene_add_moving_driver(b->scene, entry->name);
            builder_function(&f, driver, scene_drive_piece, 1);
            check_given(&f);
            continue;
        }
        check_given(&f);
        const int driver =
            scene_add_unknown_driver(b->scene, entry->name, SCENE_NONE, SCENE_UX, SCENE_NONE);
        if (driver >= 0)
            fields_read(&f, entry_driver, &b->scene->driver[driver]);
    }
}
