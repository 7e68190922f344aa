/* Numbers, texts and names of a scene file. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/scene_writer/write_impl.h"

const char *const write_values_component[6] = {"ux", "uy", "uz", "rx", "ry", "rz"};

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
    fprintf(w->to, ", %s: ", key);
    write_values_number(w, value);
}

void write_values_quoted(writer *w, const char *text)
{
    fputc('"', w->to);
    for (; *text != '\0'; text++)
        fprintf(w->to, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    fputc('"', w->to);
}

/* Letters, digits and _, and no other motion's. */
static int is_good_name(const scene *s, int index)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    const char *name = s->driver[index].name;
    if (name[0] == '\0' || name[strspn(name, letters)] != '\0' || strcmp(name, "free") == 0 ||
        strcmp(name, "held") == 0)
        return 0;
    for (int i = 0; i < s->drivers; i++)
        if (i != index && strcmp(s->driver[i].name, name) == 0)
            return 0;
    return 1;
}

void write_values_motion(writer *w, int index)
{
    if (is_good_name(w->scene, index))
        fputs(w->scene->driver[index].name, w->to);
    else
        fprintf(w->to, "motion_%d", index);
}

void write_values_matrix(writer *w, const char *key, const double A[36])
{
    double diagonal[6];
    int whole = 0;
    for (int k = 0; k < 36; k++)
        whole |= k % 7 != 0 && A[k] != 0;
    for (int k = 0; k < 6; k++)
        diagonal[k] = A[7 * k];
    fputs(key, w->to);
    write_values_numbers(w, whole ? 36 : 6, whole ? A : diagonal);
}
