#include "harness/formulations/plugin.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/process.h"

static status refuse(const char *path, const char *why, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "%.100s: %.180s", path, why);
}

static int is_name(const char *text)
{
    return text != NULL && text[0] != '\0' &&
           text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0';
}

/* The first of what it must have. */
static status check(const char *path, const element_type *t, fault *f)
{
    const char *why = NULL;
    if (!is_name(t->name) || strlen(t->name) > 60)
        why = "its .name is no word of small letters, digits and _; give one of at most 60";
    else if (t->summary == NULL || t->source == NULL || t->family == NULL)
        why = "give it .summary, .source and .family";
    else if (t->prepare == NULL || t->data_size == NULL)
        why = "give it .prepare and .data_size";
    return why != NULL ? refuse(path, why, f) : STATUS_OK;
}

/* What was appended to the interface after it was compiled is zero. */
static status copy(const char *path, const element_type *loaded, const element_type **out, fault *f)
{
    if (loaded->abi != ELEMENT_ABI)
        return fault_set(f, STATUS_REFUSED,
                         "%.100s: written for version %u of the element interface, this is %d; "
                         "compile it with the headers of this program",
                         path, loaded->abi, ELEMENT_ABI);
    if (loaded->size < offsetof(element_type, name) + sizeof(char *) ||
        loaded->size > sizeof(element_type))
        return fault_set(f, STATUS_REFUSED,
                         "%.100s: its element_type has %zu bytes, at most %zu are known here; set "
                         ".size = sizeof(element_type) and compile it with the headers of this "
                         "program",
                         path, loaded->size, sizeof(element_type));
    element_type *t = calloc(1, sizeof *t);
    if (t == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %.100s", path);
    memcpy(t, loaded, loaded->size);
    /* a type that has a theory of shear offers it */
    t->offers |= t->shear_theories & SHEAR_ENGESSER ? FEATURE_ENGESSER : 0;
    t->offers |= t->shear_theories & SHEAR_HARINGX ? FEATURE_HARINGX : 0;
    const status outcome = check(path, t, f);
    if (outcome != STATUS_OK)
        free(t);
    else
        *out = t;
    return outcome;
}

status plugin_load(const char *path, const element_type **out, fault *f)
{
    static const char exec[] = "exec:";
    if (strncmp(path, exec, sizeof exec - 1) == 0)
        return process_load(path + sizeof exec - 1, out, f);
    void *file = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (file == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "cannot load %.200s: is it a shared object? A path has a '/': ./mine.so; a "
            "command 'exec:' before it",
            dlerror());
    const element_type *loaded = dlsym(file, "beamwork_element");
    if (loaded == NULL)
        return refuse(
            path, "no symbol 'beamwork_element'; define 'const element_type beamwork_element'", f);
    return copy(path, loaded, out, f);
}
