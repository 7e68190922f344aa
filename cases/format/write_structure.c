/* Nodes, members, springs, motions and loads of a scene file. */

#include "cases/format/write_impl.h"

/* hold: [...] and drive: {...} of the first `count` components. */
static void write_supports(writer *w, const scene_node *n, int count)
{
    int held = 0, driven = 0, how[6];
    for (int c = 0; c < count; c++)
        how[c] = c < SCENE_RX ? n->translation[c] : n->angle[c - SCENE_RX];
    for (int c = 0; c < count; c++)
        if (how[c] == SCENE_HELD)
            fprintf(w->to, "%s%s", held++ == 0 ? ", hold: [" : ", ", write_values_component[c]);
    fputs(held > 0 ? "]" : "", w->to);
    for (int c = 0; c < count; c++)
        if (how[c] >= 0) {
            fprintf(w->to, "%s%s: ", driven++ == 0 ? ", drive: {" : ", ",
                    write_values_component[c]);
            write_values_motion(w, how[c]);
        }
    fputs(driven > 0 ? "}" : "", w->to);
}

static void write_angle(writer *w, int how)
{
    if (how >= 0)
        write_values_motion(w, how);
    else
        fputs(how == SCENE_HELD ? "held" : "free", w->to);
}

static void write_rotation(writer *w, const scene_node *n)
{
    if (n->rotation == SCENE_ROTATION_FORK) {
        fputs(", fork: {axis: ", w->to);
        write_values_numbers(w, 3, n->axis[0]);
        fputs(", web: ", w->to);
        write_values_numbers(w, 3, n->axis[1]);
        fputc('}', w->to);
        return;
    }
    const int vector = n->rotation == SCENE_ROTATION_VECTOR;
    fputs(vector ? ", rotation: {vector: [" : ", rotation: {sequence: [", w->to);
    for (int i = 0; i < 3 && (vector || write_values_any(3, n->axis[i])); i++) {
        fputs(i > 0 ? ", " : "", w->to);
        if (!vector) {
            fputs("{axis: ", w->to);
            write_values_numbers(w, 3, n->axis[i]);
            fputs(", angle: ", w->to);
        }
        write_angle(w, n->angle[i]);
        fputs(vector ? "" : "}", w->to);
    }
    fputs("]}", w->to);
}

static void write_body(writer *w, const scene_body *b)
{
    write_values_if(w, "mass", b->mass, 0);
    if (write_values_any(3, b->centre)) {
        fputs(", centre: ", w->to);
        write_values_numbers(w, 3, b->centre);
    }
    if (write_values_any(6, b->inertia)) {
        fputs(", inertia: ", w->to);
        write_values_numbers(w, 6, b->inertia);
    }
}

void write_structure_nodes(writer *w)
{
    fputs("nodes:\n", w->to);
    for (int i = 0; i < w->scene->nodes; i++) {
        const scene_node *n = &w->scene->node[i];
        write_values_named(w, "  ", SCENE_NODES, i);
        fputs(": {at: ", w->to);
        write_values_numbers(w, 3, n->position);
        if (n->attached != SCENE_NONE)
            write_values_named(w, ", part_of: ", SCENE_NODES, n->attached);
        write_supports(w, n, n->rotation == SCENE_ROTATION_SPATIAL ? 6 : 3);
        if (n->rotation != SCENE_ROTATION_SPATIAL)
            write_rotation(w, n);
        write_body(w, &n->body);
        fputs("}\n", w->to);
    }
}

static void write_warping(writer *w, int warp)
{
    if (warp >= 0)
        fprintf(w->to, "{shared: w%d}", warp);
    else
        fputs(warp == SCENE_WARP_FREE ? "free" : "fixed", w->to);
}

static void write_release(writer *w, const scene_release release[2])
{
    static const char *const end[] = {"from", "to"};
    if (release[0].count + release[1].count == 0)
        return;
    fputs(", release: {", w->to);
    for (int i = 0; i < 2; i++) {
        if (release[i].count == 0)
            continue;
        fprintf(w->to, "%s%s: [", i == 1 && release[0].count > 0 ? ", " : "", end[i]);
        for (int k = 0; k < release[i].count; k++)
            fprintf(w->to, "%s%s", k > 0 ? ", " : "",
                    write_values_component[release[i].component[k]]);
        fputc(']', w->to);
    }
    fputc('}', w->to);
}

void write_structure_members(writer *w)
{
    fputs("members:\n", w->to);
    for (int i = 0; i < w->scene->members; i++) {
        const scene_member *m = &w->scene->member[i];
        write_values_named(w, "  ", SCENE_MEMBERS, i);
        write_values_named(w, ": {from: ", SCENE_NODES, m->p);
        write_values_named(w, ", to: ", SCENE_NODES, m->q);
        write_values_named(
            w, scene_member_tapers(m) ? ", section: [" : ", section: ", SCENE_SECTIONS, m->section);
        if (scene_member_tapers(m)) {
            write_values_named(w, ", ", SCENE_SECTIONS, m->section_q);
            fputc(']', w->to);
        }
        fputs(", y: ", w->to);
        write_values_numbers(w, 3, m->y_axis);
        fputs(", warping: [", w->to);
        write_warping(w, m->warp_p);
        fputs(", ", w->to);
        write_warping(w, m->warp_q);
        fputc(']', w->to);
        if (write_values_any(3, m->curvature)) {
            fputs(", curvature: ", w->to);
            write_values_numbers(w, 3, m->curvature);
        }
        if (write_values_any(3, m->strain)) {
            fputs(", strain: ", w->to);
            write_values_numbers(w, 3, m->strain);
        }
        write_release(w, m->release);
        write_values_if(w, "damping", m->damping, 0);
        write_values_if(w, "divisions", m->divisions, 0);
        fputs("}\n", w->to);
    }
}

void write_structure_springs(writer *w)
{
    fputs(w->scene->springs > 0 ? "springs:\n" : "", w->to);
    for (int i = 0; i < w->scene->springs; i++) {
        const scene_spring *p = &w->scene->spring[i];
        write_values_named(w, "  ", SCENE_SPRINGS, i);
        fputs(": {", w->to);
        if (p->p != SCENE_NONE)
            write_values_named(w, "from: ", SCENE_NODES, p->p);
        write_values_named(w, p->p != SCENE_NONE ? ", to: " : "to: ", SCENE_NODES, p->q);
        write_values_matrix(w, ", stiffness: ", p->stiffness);
        fputs("}\n", w->to);
    }
}

static void write_scaled(writer *w, const char *text, double scale)
{
    if (scale == 0 || scale == 1) {
        write_values_quoted(w, text);
        return;
    }
    fprintf(w->to, "\"(%s)*%.17g\"", text, scale);
}

/* A function of time. */
static void write_pieces(writer *w, const scene_function *f)
{
    fputs("pieces: [", w->to);
    for (int i = 0; i < f->pieces; i++) {
        fputs(i > 0 ? ", {" : "{", w->to);
        if (i < f->pieces - 1) {
            fputs("until: ", w->to);
            write_values_number(w, f->piece[i].until);
            fputs(", ", w->to);
        }
        fputs("is: ", w->to);
        write_scaled(w, f->piece[i].text, f->scale);
        fputc('}', w->to);
    }
    fputc(']', w->to);
}

static void write_table(writer *w, const scene_driver *d)
{
    fputs("path: ", w->to);
    write_values_numbers(w, d->stations, d->path);
    fputs(", value: ", w->to);
    write_values_numbers(w, d->stations, d->value);
}

void write_structure_motions(writer *w)
{
    fputs(w->scene->drivers > 0 ? "motions:\n" : "", w->to);
    for (int i = 0; i < w->scene->drivers; i++) {
        const scene_driver *d = &w->scene->driver[i];
        fputs("  ", w->to);
        write_values_motion(w, i);
        if (d->value != NULL) {
            const int table = d->function.pieces == 0 || d->stations > 1 || d->value[0] != 0;
            fputs(": {", w->to);
            if (table)
                write_table(w, d);
            fputs(table && d->function.pieces > 0 ? ", " : "", w->to);
            if (d->function.pieces > 0)
                write_pieces(w, &d->function);
        } else {
            write_values_named(w, ": {such_that: {node: ", SCENE_NODES, d->condition_node);
            fprintf(w->to, ", component: %s", write_values_component[d->condition_component]);
            write_values_named(w, ", motion: ", SCENE_DRIVERS, d->condition_driver);
            fputc('}', w->to);
        }
        fputs("}\n", w->to);
    }
}

/* Which part of its member a load acts on, and how. */
static void write_range(writer *w, const scene_load *load)
{
    if (scene_load_within(load)) {
        fputs(", where: ", w->to);
        write_values_number(w, load->range[0]);
    } else if (scene_load_along(load)) {
        write_values_if(w, "from", load->range[0], 0);
        write_values_if(w, "to", load->range[1], 1);
    }
    if (load->varies) {
        fputs(", to_value: ", w->to);
        write_values_numbers(w, 3, load->last);
    }
    fputs(load->lumped ? ", lumped: yes" : "", w->to);
}

void write_structure_loads(writer *w)
{
    static const char *const kind[] = {"force",   "moment",  "distributed", "distributed_moment",
                                       "gravity", "gravity", "force",       "moment"};
    fputs(w->scene->loads > 0 ? "loads:\n" : "", w->to);
    for (int i = 0; i < w->scene->loads; i++) {
        const scene_load *load = &w->scene->load[i];
        write_values_named(w, "  ", SCENE_LOADS, i);
        fprintf(w->to, ": {%s: ", kind[load->kind]);
        write_values_numbers(w, 3, load->vector);
        write_values_named(w, ", on: ", scene_load_along(load) ? SCENE_MEMBERS : SCENE_NODES,
                           load->where);
        write_range(w, load);
        if (write_values_any(3, load->at)) {
            fputs(", at: ", w->to);
            write_values_numbers(w, 3, load->at);
        }
        fputs(load->axes == SCENE_AXES_MEMBER ? ", axes: member" : "", w->to);
        fputs(load->follower ? ", follower: true" : "", w->to);
        if (load->stations > 0) {
            fputs(", path: ", w->to);
            write_values_numbers(w, load->stations, load->path);
            fputs(", factor: ", w->to);
            write_values_numbers(w, load->stations, load->factor);
        }
        if (load->function.pieces > 0) {
            fputs(", ", w->to);
            write_pieces(w, &load->function);
        }
        fputs("}\n", w->to);
    }
}
