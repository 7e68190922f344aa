#include "harness/formulations/formulations.h"

#include <dlfcn.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/process_impl.h"

/* Loads the type that the command describes. The type and its process exist until this process
 * ends. REFUSED: PROCESS_MOST types are already loaded, the machine is big-endian, the command
 * cannot be executed, or the first line of its output is missing or does not follow the protocol
 * (protocol.md). FAULT: out of memory, or no pipe or process can be created. */
static status process_load(const char *command, const element_type **out, fault *f);

static status refuse(const char *path, const char *why, fault *f)
{
    return fault_set(f, STATUS_REFUSED, "%.100s: %.180s", path, why);
}

static int is_name(const char *text)
{
    return text != NULL && text[0] != '\0' &&
           text[strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0';
}

/* Checks the required members. The message names the first one that is missing or wrong. */
static status check(const char *path, const element_type *t, fault *f)
{
    const char *why = NULL;
    if (!is_name(t->name) || strlen(t->name) > 60)
        why = "its .name must be a word of at most 60 lowercase letters, digits and underscores";
    else if (t->summary == NULL || t->source == NULL || t->family == NULL)
        why = ".summary, .source or .family is missing; add it";
    else if (t->prepare == NULL || t->data_size == NULL)
        why = ".prepare or .data_size is missing; add it";
    return why != NULL ? refuse(path, why, f) : STATUS_OK;
}

static status copy(const char *path, const element_type *loaded, const element_type **out, fault *f)
{
    if (loaded->abi != ELEMENT_ABI)
        return fault_set(f, STATUS_REFUSED,
                         "%.100s: the element was written for version %u of the element interface, "
                         "but this is version %d; compile it with the headers of this program",
                         path, loaded->abi, ELEMENT_ABI);
    if (loaded->size < offsetof(element_type, name) + sizeof(char *) ||
        loaded->size > sizeof(element_type))
        return fault_set(
            f, STATUS_REFUSED,
            "%.100s: its element_type has %zu bytes, but this program knows at most %zu; set .size "
            "= sizeof(element_type), and compile it with the headers of this program",
            path, loaded->size, sizeof(element_type));
    element_type *t = calloc(1, sizeof *t);
    if (t == NULL)
        return fault_memory(f, "%.100s", path);
    memcpy(t, loaded, loaded->size);
    t->offers |= t->shear_theories & SHEAR_ENGESSER ? FEATURE_ENGESSER : 0;
    t->offers |= t->shear_theories & SHEAR_HARINGX ? FEATURE_HARINGX : 0;
    const status outcome = check(path, t, f);
    if (outcome != STATUS_OK)
        free(t);
    else
        *out = t;
    return outcome;
}

/* Returns the exported formulation; NULL: none. */
static const element_type *find_type(void *file)
{
    const element_type *(*returned)(void) = NULL;
    const element_type *defined = dlsym(file, "beamwork_element");
    if (defined != NULL)
        return defined;
    *(void **)&returned = dlsym(file, "beamwork_element_type");
    return returned != NULL ? returned() : NULL;
}

static status cannot_load(fault *f)
{
    const char *why = dlerror();
    return fault_set(f, STATUS_REFUSED, "--element: %.180s; %s", why,
                     strstr(why, "undefined symbol") != NULL
                         ? "link the object or library that defines the symbol"
                         : "give the path of an existing shared object with a '/', such as "
                           "./mine.so, or a command that begins with 'exec:'");
}

status plugin_load(const char *path, const element_type **out, fault *f)
{
    static const char exec[] = "exec:";
    if (strncmp(path, exec, sizeof exec - 1) == 0)
        return process_load(path + sizeof exec - 1, out, f);
    void *file = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (file == NULL)
        return cannot_load(f);
    const element_type *loaded = find_type(file);
    if (loaded == NULL)
        return refuse(
            path,
            "it does not define a formulation; define 'const element_type beamwork_element', or a "
            "function beamwork_element_type() that returns the formulation",
            f);
    return copy(path, loaded, out, f);
}

enum { SECTION_NUMBERS = 111 };

static process *list[PROCESS_MOST];
static int limit = 120;

static process *process_of(const element_type *t)
{
    for (int i = 0; i < PROCESS_MOST && list[i] != NULL; i++)
        if (&list[i]->type == t)
            return list[i];
    return NULL;
}

int process_serves(const element_type *t)
{
    return process_of(t) != NULL;
}

void process_limit(int seconds)
{
    limit = seconds;
    for (int i = 0; i < PROCESS_MOST && list[i] != NULL; i++)
        list[i]->to.limit = seconds;
}

static size_t data_size(const element_request *request)
{
    const size_t m = (size_t)element_strains(request->type, request->options);
    return sizeof(element_data) + 2 * m * m * sizeof(double);
}

static status start_again(process *p, fault *f)
{
    char *line = malloc(HANDSHAKE_MOST + 1);
    handshake again;
    if (line == NULL)
        return fault_memory(f, "a formulation");
    status outcome = channel_start(&p->to, line, f);
    if (outcome == STATUS_OK)
        outcome = handshake_read(p->to.program_name, line, strlen(line), &again, f);
    free(line);
    p->kinds = 0;
    TRY(outcome);
    const int same =
        strcmp(again.type.name, p->type.name) == 0 && again.whole == p->whole &&
        again.type.leaves == p->type.leaves && again.inertia == (p->type.inertia != NULL) &&
        again.type.spreads == p->type.spreads && again.constants.strains == p->constants.strains &&
        again.constants.nodes == p->constants.nodes &&
        again.constants.history == p->constants.history &&
        again.constants.scalars == p->constants.scalars && again.damping == p->damping &&
        again.line == (p->type.line != NULL);
    free(again.memory);
    return same ? STATUS_OK
                : channel_break(&p->to,
                                "its first line differs when it is started again; print the same "
                                "first line every time",
                                f);
}

static void put(char **to, const void *from, size_t bytes)
{
    memcpy(*to, from, bytes);
    *to += bytes;
}

static void put_section(char **to, const section *c)
{
    const double first[14] = {c->young,    c->shear_modulus,
                              c->density,  c->A,
                              c->Iy,       c->Iz,
                              c->It,       c->Iw,
                              c->ys,       c->zs,
                              c->Ip,       c->wagner_y,
                              c->wagner_z, c->wagner_torque};
    const double angle[3] = {c->axes_angle, c->centroid[0], c->centroid[1]}, matrices = c->matrices,
                 last[3] = {c->rectangle, c->width, c->height};
    put(to, first, sizeof first);
    put(to, c->D, sizeof c->D);
    put(to, c->F, sizeof c->F);
    put(to, angle, sizeof angle);
    put(to, &matrices, sizeof matrices);
    put(to, c->stiffness, sizeof c->stiffness);
    put(to, c->mass, sizeof c->mass);
    put(to, last, sizeof last);
}

static status ask_prepare(process *p, const element_request *request, element_data *out, fault *f)
{
    const int options = parameter_count(p->type.options);
    const int64_t head[3] = {out->kind % PROCESS_KINDS, request->features, options};
    const size_t C = (size_t)(out->strains * out->strains) * sizeof(double),
                 V = p->damping != DAMPING_NONE ? C : 0,
                 most = p->whole                     ? 0
                        : p->damping == DAMPING_ONLY ? V
                                                     : C + V,
                 size = sizeof head + (7 + SECTION_NUMBERS + (size_t)options) * sizeof(double);
    const char *body;
    size_t count;
    channel_begin(&p->to);
    char *to = channel_add(&p->to, size);
    if (to == NULL)
        return fault_memory(f, "a formulation");
    put(&to, head, sizeof head);
    put(&to, &request->length, sizeof(double));
    put(&to, request->curvature, sizeof request->curvature);
    put(&to, request->strain, sizeof request->strain);
    put_section(&to, request->section);
    put(&to, request->options, (size_t)options * sizeof(double));
    TRY(channel_ask(&p->to, CHANNEL_PREPARE, 0, 1, V > 0 ? most : 0, most, &body, &count, f));
    out->linear = count > V;
    memcpy(out->C, body, count - V);
    memcpy((char *)out->C + C, body + count - V, V);
    return STATUS_OK;
}

static status prepare_locked(process *p, const element_request *request, element_data *out,
                             fault *f)
{
    if (p->to.trouble[0] != '\0' && !p->to.reported)
        return fault_set(f, STATUS_FAULT, "%s", p->to.trouble);
    if (!channel_runs(&p->to))
        TRY(start_again(p, f));
    *out = (element_data){.of = p,
                          .started = p->to.started,
                          .kind = p->kinds++,
                          .strains = p->constants.strains,
                          .history = p->constants.history,
                          .scalars = p->constants.scalars,
                          .coordinates = (NODE_COORDINATES + p->constants.scalars) *
                                         element_nodes(&p->type, request->options)};
    return ask_prepare(p, request, out, f);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    process *p = process_of(request->type);
    pthread_mutex_lock(&p->to.lock);
    const status outcome = prepare_locked(p, request, out, f);
    p->to.reported |= outcome != STATUS_OK;
    pthread_mutex_unlock(&p->to.lock);
    return outcome == STATUS_FAULT ? STATUS_NOT_CONVERGED : outcome;
}

static const char *trouble(const element_data *d)
{
    channel *c = &d->of->to;
    if (c->trouble[0] == '\0' || c->reported)
        return NULL;
    c->reported = 1;
    return c->trouble;
}

static status check_machine(const char *command, fault *f)
{
    const int64_t one = 1;
    char first;
    memcpy(&first, &one, 1);
    return first == 1 ? STATUS_OK
                      : fault_set(f, STATUS_REFUSED,
                                  "exec:%.100s: this machine is big-endian; use a little-endian "
                                  "machine, as the protocol requires",
                                  command);
}

static status begin(process *p, const char *command, fault *f)
{
    char *line = malloc(HANDSHAKE_MOST + 1);
    handshake said;
    if (line == NULL)
        return fault_memory(f, "a formulation");
    status outcome = channel_init(&p->to, command, f);
    p->to.limit = limit;
    if (outcome == STATUS_OK)
        outcome = channel_start(&p->to, line, f);
    if (outcome == STATUS_OK)
        outcome = handshake_read(p->to.program_name, line, strlen(line), &said, f);
    free(line);
    TRY(outcome);
    p->type = said.type;
    p->constants = said.constants;
    p->memory = said.memory;
    p->whole = said.whole;
    p->type.constants = &p->constants;
    p->type.data_size = data_size;
    p->type.prepare = prepare;
    p->type.trouble = trouble;
    frames_serve(p);
    if (said.inertia)
        frames_serve_inertia(p);
    if (said.constants.history > 0)
        frames_serve_history(p);
    p->damping = said.damping;
    if (said.damping != DAMPING_NONE)
        frames_serve_damping(p);
    if (said.line)
        frames_serve_line(p);
    return channel_call(&p->to, p->type.name, f);
}

static status process_load(const char *command, const element_type **out, fault *f)
{
    int count = 0;
    while (count < PROCESS_MOST && list[count] != NULL)
        count++;
    if (count == PROCESS_MOST)
        return fault_set(f, STATUS_REFUSED,
                         "at most %d formulations can run in their own processes; give fewer "
                         "--element options with exec:",
                         PROCESS_MOST);
    TRY(check_machine(command, f));
    process *p = calloc(1, sizeof *p);
    if (p == NULL)
        return fault_memory(f, "a formulation");
    const status outcome = begin(p, command, f);
    if (outcome != STATUS_OK) {
        channel_end(&p->to);
        free(p->memory);
        free(p);
        return outcome;
    }
    list[count] = p;
    *out = &p->type;
    return STATUS_OK;
}
