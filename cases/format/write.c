#include "cases/format/write.h"

#include <stdlib.h>

#include "cases/format/write_impl.h"
#include "cases/scene/omission.h"

static void write_physics(writer *w)
{
    char words[SCENE_OMISSION_WORDS];
    scene_omission_words(w->scene->omits, words);
    if (w->scene->omits == SCENE_OMITTABLE)
        fputs("omit: all\n", w->to);
    else if (w->scene->omits != 0)
        fprintf(w->to, "omit: [%s]\n", words);
    if (w->scene->shear_theory != SCENE_SHEAR_HARINGX)
        fprintf(w->to, "shear_theory: %s\n", scene_shear_word(w->scene->shear_theory));
    if (w->scene->lumped)
        fputs("mass: lumped\n", w->to);
}

static void write_meshes(writer *w)
{
    fputs("meshes: [", w->to);
    for (int i = 0; i < w->scene->meshes; i++)
        fprintf(w->to, "%s%d", i > 0 ? ", " : "", w->scene->mesh[i]);
    fputs("]\n", w->to);
}

static void write_line(writer *w, const char *key, const char *text)
{
    if (text == NULL || text[0] == '\0')
        return;
    fprintf(w->to, "%s: ", key);
    write_values_quoted(w, text);
    fputc('\n', w->to);
}

status write_scene(FILE *to, const scene *s, const write_head *head, fault *f)
{
    writer w = {.to = to, .scene = s, .begun = 1};
    fprintf(to, "beamwork: 1\nname: %s\n", head->name);
    write_line(&w, "summary", head->summary);
    write_line(&w, "source", head->source);
    write_sections(&w);
    write_structure(&w);
    write_analyses(&w);
    write_quantities(&w);
    if (s->plane != SCENE_SPACE)
        fprintf(to, "plane: %s\n", scene_plane_name(s));
    write_physics(&w);
    write_meshes(&w);
    return w.unwritable ? fault_set(f, STATUS_REFUSED,
                                    "%s: a number is infinite; no scene "
                                    "file can say it",
                                    head->name)
                        : STATUS_OK;
}

char *write_scene_text(const scene *s, const write_head *head)
{
    char *text = NULL;
    size_t size = 0;
    fault f;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    const status written = s != NULL ? write_scene(to, s, head, &f) : STATUS_REFUSED;
    if (fclose(to) != 0) {
        free(text);
        return NULL;
    }
    if (written != STATUS_OK)
        text[0] = '\0';
    return text;
}
