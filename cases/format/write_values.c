/* Numbers, texts and names of a scene file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/write_impl.h"
#include "elements/shared/choice.h"

const char *const write_values_component[6] = {"ux", "uy", "uz", "rx", "ry", "rz"};

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789.";

void write_values_key(writer *w, const char *key)
{
    fprintf(w->to, "%s%s: ", w->begun ? ", " : "", key);
    w->begun = 1;
}

void write_values_word(writer *w, const char *words, int index)
{
    char word[SCENE_NAME];
    choice_name(words, index, word, sizeof word);
    fputs(word, w->to);
}

void write_values_bits(writer *w, const char *words, unsigned bits)
{
    const char *before = "[";
    for (int i = 0; bits >> i != 0; i++)
        if (bits >> i & 1u) {
            fputs(before, w->to);
            write_values_word(w, words, i);
            before = ", ";
        }
    fputc(']', w->to);
}

void write_values_number(writer *w, double value)
{
    char text[40];
    if (!isfinite(value)) {
        w->unwritable = 1;
        return;
    }
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, w->to);
}

void write_values_numbers(writer *w, int count, const double value[])
{
    fputc('[', w->to);
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? ", " : "", w->to);
        write_values_number(w, value[i]);
    }
    fputc(']', w->to);
}

int write_values_any(int count, const double value[])
{
    for (int i = 0; i < count; i++)
        if (value[i] != 0)
            return 1;
    return 0;
}

void write_values_if(writer *w, const char *key, double value, double otherwise)
{
    if (value == otherwise && !signbit(value) == !signbit(otherwise))
        return;
    write_values_key(w, key);
    write_values_number(w, value);
}

void write_values_quoted(writer *w, const char *text)
{
    fputc('"', w->to);
    for (; *text != '\0'; text++)
        fprintf(w->to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    fputc('"', w->to);
}

/* Has the node weight, and a member its name? `gravity` takes the member first. */
static int is_mistaken(const scene *s, int node, const char *name)
{
    int weighs = 0, other = 0;
    for (int i = 0; i < s->loads; i++)
        weighs |= s->load[i].kind == SCENE_WEIGHT && s->load[i].where == node;
    for (int i = 0; weighs && i < s->members; i++)
        other |= strcmp(scene_own_name(s, SCENE_MEMBERS, i), name) == 0;
    return other;
}

/* No other entry of the list is called so, and a key can be. */
static int is_good_name(const scene *s, scene_list list, int index, const char *name)
{
    static const char *const taken[] = {"free", "held", "all"};
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++)
        if (strcmp(name, taken[i]) == 0)
            return 0;
    if (name[strspn(name, letters)] != '\0')
        return 0;
    for (int i = 0; i < index; i++)
        if (strcmp(scene_own_name(s, list, i), name) == 0)
            return 0;
    return list != SCENE_NODES || !is_mistaken(s, index, name);
}

void write_values_name(writer *w, scene_list list, int index)
{
    const scene_words name = scene_name(w->scene, list, index);
    const int good = is_good_name(w->scene, list, index, name.text);
    fputs(good ? name.text : scene_numbered(w->scene, list, index).text, w->to);
}

void write_values_named(writer *w, const char *before, scene_list list, int index)
{
    fputs(before, w->to);
    write_values_name(w, list, index);
}

void write_values_motion(writer *w, int index)
{
    write_values_name(w, SCENE_DRIVERS, index);
}

void write_values_matrix(writer *w, const double A[36])
{
    double diagonal[6];
    int whole = 0;
    for (int k = 0; k < 36; k++)
        whole |= k % 7 != 0 && A[k] != 0;
    for (int k = 0; k < 6; k++)
        diagonal[k] = A[7 * k];
    write_values_numbers(w, whole ? 36 : 6, whole ? A : diagonal);
}
