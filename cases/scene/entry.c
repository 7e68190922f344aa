#include "cases/scene/scene_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

/* Returns 1 if the key is not a map of a group, or if it is the map of the kind that the entry
 * has. */
static int entry_stands(const entry_field *, const void *entry);

static const void *frame_motion_of(const entry_field *k, const void *entry)
{
    return (const char *)entry + k->at;
}

static int whole_of(const entry_field *k, const void *entry)
{
    int value;
    memcpy(&value, frame_motion_of(k, entry), sizeof value);
    return value;
}

/* Returns the number of values of the key and sets *out to the first. Returns 0 if the values are
 * not numbers. */
static int numbers_of(const entry_field *k, const void *entry, const double **out)
{
    const scene_path *path = frame_motion_of(k, entry);
    *out = frame_motion_of(k, entry);
    switch (k->size > 0 ? k->kind : ENTRY_LATER) {
    case ENTRY_NUMBER:
        return 1;
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        return k->count;
    case ENTRY_NUMBERS:
        *out = path->value;
        return path->stations;
    default:
        return 0;
    }
}

const entry_field *entry_below(const entry_field *k)
{
    return k->type != NULL ? k->type->field : k->below;
}

const char *entry_summary(const entry_field *k)
{
    return k->type != NULL ? k->type->summary : k->summary;
}

int entry_value(const entry_field *k, int index)
{
    return k->first + (k->falls > 0 ? -k->falls * index : index);
}

int entry_index(const entry_field *k, int value)
{
    return k->falls > 0 ? (k->first - value) / k->falls : value - k->first;
}

double entry_usual(const entry_field *k)
{
    return k->usual != NULL ? strtod(k->usual, NULL) : k->otherwise;
}

static int same_number(double a, double b)
{
    return (a == b && !signbit(a) == !signbit(b)) || (isnan(a) && isnan(b));
}

static int all_usual(const entry_field *table, const void *entry)
{
    int usual = 1;
    for (; usual && table->name != NULL; table++)
        usual = entry_is_usual(table, entry);
    return usual;
}

static int is_stored_zero(const entry_field *k, const void *entry)
{
    unsigned bits = 0;
    memcpy(&bits, (const char *)entry + k->zeros, sizeof bits);
    return (bits & k->zero) != 0;
}

int entry_is_usual(const entry_field *k, const void *entry)
{
    const double *number;
    const int count = numbers_of(k, entry, &number);
    switch (k->kind) {
    case ENTRY_NUMBER:
        return k->size == 0 || (same_number(*number, entry_usual(k)) && !is_stored_zero(k, entry));
    case ENTRY_MAP:
        return k->size > 0 ? !entry_stands(k, entry) : all_usual(entry_below(k), entry);
    case ENTRY_NAME:
        return k->size == 0 || whole_of(k, entry) == SCENE_NONE;
    case ENTRY_WHOLE:
        return k->size == 0 || whole_of(k, entry) == (int)entry_usual(k);
    case ENTRY_FLAG:
    case ENTRY_WORDS:
        return k->size == 0 || whole_of(k, entry) == 0;
    case ENTRY_WORD:
        return k->size != sizeof(int) || whole_of(k, entry) == entry_word(k, k->usual);
    case ENTRY_NUMBERS:
        return count == 0;
    default:
        for (int i = 0; i < count; i++)
            if (number[i] != 0)
                return 0;
        return 1;
    }
}

int entry_word(const entry_field *k, const char *word)
{
    const int index = word != NULL ? choice_index(k->words, word) : -1;
    return index < 0 ? (int)k->otherwise : entry_value(k, index);
}

static int entry_stands(const entry_field *k, const void *entry)
{
    if (k->type != NULL)
        return quantity_type_of(entry) == k->type;
    return k->size == 0 || whole_of(k, entry) == k->first;
}

int entry_in_range(const entry_field *k, double value)
{
    return isfinite(value) && (!(k->least < k->most) || (value >= k->least && value <= k->most));
}

const char *entry_range(const entry_field *k, char text[FAULT_TEXT])
{
    const char *whole = k->kind == ENTRY_WHOLE ? "a whole number " : "";
    if (k->range != NULL)
        return k->range;
    if (!(k->least < k->most))
        return "a finite number";
    if (isfinite(k->most))
        snprintf(text, FAULT_TEXT, "%sfrom %.10g to %.10g", whole, k->least, k->most);
    else
        snprintf(text, FAULT_TEXT, "%sat least %g", whole, k->least);
    return text;
}

static status check_number(const entry_field *k, double value, fault *f)
{
    char range[FAULT_TEXT];
    const int none = isnan(k->otherwise) && isnan(value);
    return none || entry_in_range(k, value) ? STATUS_OK
                                            : fault_set(f, STATUS_REFUSED, "%s = %g; give %s",
                                                        k->name, value, entry_range(k, range));
}

static status check_name(const scene *s, const entry_field *k, int index, fault *f)
{
    const char *what = scene_list_word(k->of);
    if ((index == SCENE_NONE && !k->needed) || (index >= 0 && index < scene_count(s, k->of)))
        return STATUS_OK;
    if (index == SCENE_NONE)
        return fault_set(f, STATUS_REFUSED, "%s: no %s is named; name one", k->name, what);
    return fault_set(f, STATUS_REFUSED, "%s: %s %d does not exist; add the %s first", k->name, what,
                     index, what);
}

static status check_word(const entry_field *k, int value, fault *f)
{
    char word[SCENE_NAME] = "";
    const int index = entry_index(k, value);
    if (index >= 0)
        choice_name(k->words, index, word, sizeof word);
    return word[0] != '\0' || value == entry_word(k, k->usual)
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED, "%s: the value %d is invalid; give one of %.100s",
                           k->name, value, k->words);
}

static status check_field(const scene *s, const entry_field *k, const void *entry, fault *f)
{
    const double *number;
    const int count = numbers_of(k, entry, &number);
    for (int i = 0; i < count; i++)
        TRY(check_number(k, number[i], f));
    switch (k->size == sizeof(int) ? k->kind : ENTRY_LATER) {
    case ENTRY_WHOLE:
        return check_number(k, whole_of(k, entry), f);
    case ENTRY_NAME:
        return check_name(s, k, whole_of(k, entry), f);
    case ENTRY_WORD:
        return check_word(k, whole_of(k, entry), f);
    default:
        return STATUS_OK;
    }
}

status entry_check(const scene *s, const entry_field *table, const void *entry, fault *f)
{
    for (const entry_field *k = table; k->name != NULL; k++)
        if (k->kind != ENTRY_MAP)
            TRY(check_field(s, k, entry, f));
        else if (k->size > 0 ? entry_stands(k, entry) : !entry_is_usual(k, entry))
            TRY(entry_check(s, entry_below(k), entry, f));
    return STATUS_OK;
}

/* Returns the power of a base unit (m or N) in a word of a unit: m, N, kg = N s^2/m, Pa = N/m^2, J
 * = N m, W = N m/s. Returns 0 for other words. */
static int base_power(const char *word, size_t size, entry_base base)
{
    static const struct {
        const char *word;
        int power[2];
    } all[] = {{"m", {1, 0}},   {"N", {0, 1}}, {"kg", {-1, 1}},
               {"Pa", {-2, 1}}, {"J", {1, 1}}, {"W", {1, 1}}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strlen(all[i].word) == size && strncmp(all[i].word, word, size) == 0)
            return all[i].power[base];
    return 0;
}

int entry_power(const char *unit, entry_base base)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    int power = 0, side = 1;
    while (*unit != '\0') {
        const size_t size = strspn(unit, letters);
        const int times = unit[size] == '^' ? unit[size + 1] - '0' : 1;
        power += side * times * base_power(unit, size, base);
        side = *unit == '/' ? -1 : side;
        unit += size > 0 ? size : 1;
    }
    return power;
}

void entry_scale(const entry_field *table, void *entry, entry_base base, double times)
{
    for (const entry_field *k = table; k->name != NULL; k++) {
        const double *from;
        const int count = k->unit != NULL ? numbers_of(k, entry, &from) : 0;
        double *number = (double *)((char *)entry + k->at);
        if (k->kind == ENTRY_NUMBERS)
            number = ((scene_path *)((char *)entry + k->at))->value;
        for (int i = 0; i < count; i++)
            number[i] *= pow(times, entry_power(k->unit, base));
        if (k->kind == ENTRY_MAP && entry_stands(k, entry))
            entry_scale(entry_below(k), entry, base, times);
    }
}

void entry_mirror(const entry_field *table, void *entry)
{
    for (const entry_field *k = table; k->name != NULL; k++) {
        double *number = (double *)((char *)entry + k->at);
        for (size_t i = 0; k->mirrors != NULL && i < strlen(k->mirrors); i++)
            number[i] *= k->mirrors[i] == '-' ? -1 : 1;
        if (k->kind == ENTRY_MAP && entry_stands(k, entry))
            entry_mirror(entry_below(k), entry);
    }
}

static int same_field(const entry_field *k, const void *a, const void *b)
{
    const double *x, *y;
    const int count = numbers_of(k, a, &x), other = numbers_of(k, b, &y);
    if (k->kind == ENTRY_MAP)
        return entry_stands(k, a) == entry_stands(k, b) &&
               (!entry_stands(k, a) || entry_same(entry_below(k), a, b));
    if (k->size > 0 && k->kind != ENTRY_NUMBERS)
        return memcmp(frame_motion_of(k, a), frame_motion_of(k, b), k->size) == 0;
    return count == other && (count == 0 || memcmp(x, y, (size_t)count * sizeof *x) == 0);
}

int entry_same(const entry_field *table, const void *a, const void *b)
{
    for (; table->name != NULL; table++)
        if (!same_field(table, a, b))
            return 0;
    return 1;
}
