function out = beamwork_element(first, varargin)
% A beam formulation in Octave for beamwork --element 'exec:octave-cli -qf my_beam.m'.
%
% beamwork_element(@prepare, 'strain', @strain, what it is: names and values) speaks the protocol
% of harness/formulations/protocol.md; see the example timoshenko.m in this folder. N elements at once, the
% last index; n nodes, m strains. Functions (first argument: the kind of element that all N are):
%   C = prepare(kind)             C(m,m), constant: sigma = C e; or []. Once for each kind; with
%                           [C, kind] it keeps in kind what it computes. kind.length, .curvature(3),
%                           .strain(3), .section.young ..., .features.shear ..., .options.NAME
%   e = strain(kind, r, u, R, a)  e(m,N) of r(3,n,N), u(3,n,N), R(3,3,n,N), a(n,N)
%   [energy, sigma, C] = stress(kind, e)      (1,N), (m,N), (m,m,N); where prepare gives []
%   h = begin(kind, r, u, R, a)   h(q,N), with 'history', q, 'begin', @begin, 'commit', @commit: values
%                           of undeformed elements. strain or force then has one more argument, h of
%                           the last accepted state, the end of a load step or time step
%   h = commit(kind, r, u, R, a, h)           h of an accepted state, which was reached from h
%   V = damping(kind)             V(m,m), with 'damping', @damping: strain rates e' add V e' to the stresses
%                           in motions, damped modes and harmonic analyses
%   [energy, F, K] = force(kind, r, u, R, a)  (1,N), (7n,N), (7n,7n,N); 'force', @force in place of
%                           strain and stress; with 'gives', 'energy' or 'force' the first of them
%   [place, axes] = line(kind, at, r, u, R, a)      (3,N), (3,3,N), with 'line', @line: position and axes of
%                           the sections at(1,N), from 0 to 1 along the element, on which loads along it
%                           do work; not with 'history'
% With 'scalars', w, nodes have w additional unknowns: a is followed by s(w,n,N), and the coordinates of
% F and K are those of all nodes, then s. Not with 'line'.
% Derivatives of strains are complex steps: strain and line must take complex arrays and be analytic (.' for
% ', no abs, norm, dot, comparison of values). With 'gives', 'e' it is called with real arrays only
% and beamwork takes differences. For real and for complex arrays there are
%   beamwork_element('product', A, B)       of matrices (3,3,...) and (3,3,...) or (3,1,...)
%   beamwork_element('transpose', A)        (3,3,...)
%   beamwork_element('rotation_vector', T)  (3,N) of rotations T(3,3,N) by less than pi
%   beamwork_element('sinc', x)             sin(x)/x
% error('beamwork:refused', why) for what cannot be done. What is printed goes to standard error.
% Octave 7 or later. MATLAB was not tried: it needs /dev/stdin and /dev/stdout, scripts may begin
% with functions from R2024a on, and without dup2 whatever it prints breaks the protocol.
if ischar(first)
    tools = struct('product', @product, 'transpose', @transposed, 'sinc', @sine_by_angle, ...
                   'rotation_vector', @rotation_vector);
    out = tools.(first)(varargin{:});
else
    serve(struct('prepare', first), varargin);
end
end

function serve(call, words)
% Answers until beamwork has no more requests.
said = struct('beamwork', 1);
for i = 1:2:numel(words)
    if isa(words{i + 1}, 'function_handle')
        call.(words{i}) = words{i + 1};
    else
        said.(words{i}) = words{i + 1};
    end
end
gives = {'e,J,H', 'tangent'};
if ~isfield(said, 'gives'), said.gives = gives{1 + isfield(call, 'force')}; end
if isfield(call, 'line'), said.line = true; end
if isfield(call, 'damping')
    said.damping = true;
    if isfield(call, 'stress'), said.damping = 'only V'; end % without C
end
if isfield(said, 'options') && isstruct(said.options), said.options = num2cell(said.options); end
in = fopen('/dev/stdin', 'r', 'ieee-le');
to = fopen('/dev/stdout', 'w', 'ieee-le');
flush = @(file) 0; % MATLAB has none for files and needs none
if exist('OCTAVE_VERSION', 'builtin')
    flush = @fflush;
    dup2(stderr, stdout);
    history_save(false);
end
fwrite(to, [unicode2native(jsonencode(said), 'UTF-8'), 10], 'uint8');
flush(to);
kinds = {};
while numel(fread(in, [1 8], 'uint8')) == 8
    head = fread(in, [1 4], 'int64'); % what, mask, elements, bytes of the body
    numbers = fread(in, [1 head(3) + 2 * (head(1) == 1)], 'int64');
    body = fread(in, [head(4) / 8 - numel(numbers) 1], 'double');
    outcome = 0;
    precision = 'double';
    try
        if head(1) == 1
            [values, kinds{numbers(1) + 1}] = prepared(said, call, numbers(2), body);
        else
            values = answer(said, call, kinds, head(1), bitget(head(2), 1:5) == 1, numbers, body);
        end
        count = 8 * numel(values);
    catch why
        text = regexprep(why.message, ' near line \d+, column \d+$', '');
        if ~strcmp(why.identifier, 'beamwork:refused') && ~isempty(why.stack)
            text = sprintf('%s (%s, line %d)', text, why.stack(1).name, why.stack(1).line);
        end
        values = unicode2native(regexprep(text, '\s+', ' '), 'UTF-8');
        values = values(1:min(end, 300));
        [outcome, count, precision] = deal(3, numel(values), 'uint8');
    end
    fwrite(to, 'beamwork', 'uint8');
    fwrite(to, [outcome, count], 'int64');
    fwrite(to, values, precision);
    flush(to);
end
end

function [values, kind] = prepared(said, call, bits, body)
% A kind of elements from the body of a request to prepare it; its constant stiffness.
features = {'warping', 'shear', 'eccentric_shear_centre', 'trapeze', 'wagner_moments', ...
            'wagner_torque', 'engesser', 'haringx', 'geometric', 'large_rotations', 'mass', ...
            'rotary_inertia', 'initial_curvature', 'coupled_section'};
names = {'young', 'shear_modulus', 'density', 'A', 'Iy', 'Iz', 'It', 'Iw', 'ys', 'zs', 'Ip', ...
         'wagner_y', 'wagner_z', 'wagner_torque', 'D', 'F', 'axes_angle', 'centroid', ...
         'matrices', 'stiffness', 'mass', 'rectangle', 'width', 'height'};
shapes = [ones(14, 2); 3 3; 3 3; 1 1; 2 1; 1 1; 6 6; 6 6; ones(3, 2)];
kind = struct('length', body(1), 'curvature', body(2:4), 'strain', body(5:7), 'options', struct());
at = 7;
for i = 1:numel(names)
    count = prod(shapes(i, :));
    kind.section.(names{i}) = reshape(body(at + (1:count)), shapes(i, [2 1])).';
    at = at + count;
end
for i = 1:numel(features)
    kind.features.(features{i}) = bitget(bits, i) == 1;
end
for i = 1:numel(body) - at
    option = said.options{i};
    value = body(at + i);
    if isfield(option, 'choices'), value = option.choices{value + 1}; end
    kind.options.(option.name) = value;
end
if nargout(call.prepare) == 2
    [C, kind] = call.prepare(kind);
else
    C = call.prepare(kind);
end
if ~isempty(C), C = sized(C, [said.strains said.strains], 'prepare'); end
values = reshape(C.', [], 1);
if isfield(call, 'damping')
    if isfield(call, 'stress') && ~isempty(C)
        error('prepare returned C, but the function stress is given, too: give one of them');
    end
    V = sized(call.damping(kind), [said.strains said.strains], 'damping');
    values = [values; reshape(V.', [], 1)];
end
end

function values = answer(said, call, kinds, what, mask, numbers, body)
% All numbers that the mask asks for, in the order of the protocol.
N = numel(numbers);
n = 2;
if isfield(said, 'nodes'), n = said.nodes; end
if what == 3, first = numel(body); else, first = 16 * n * N; end
x = reshape(body(1:first), [], N);
w = 0;
if isfield(said, 'scalars') && what ~= 3, w = said.scalars; end
y = reshape(body(first + (1:w * n * N)), w, n, N);
first = first + w * n * N;
if what == 8
    values = sections(call, kinds, mask, numbers, x, n, body(first + 1:end));
    return;
end
mask = mask(1:3);
q = 0;
if isfield(said, 'history'), q = said.history; end
h = [];
second = first;
if q > 0 && any(what == [2 4 7])
    second = first + q * N;
    h = reshape(body(first + 1:second), q, N);
end
s = reshape(body(second + 1:end), [], N);
if any(what == [6 7])
    values = histories(call, kinds, what, numbers, x, y, h, q);
    return;
end
whole = {[], [], []};
for number = unique(numbers)
    alike = find(numbers == number);
    kind = kinds{number + 1};
    most = 1024;
    if what == 2 && mask(3), most = 8; end % each is evaluated in some hundred states
    for k = 1:most:numel(alike)
        of = alike(k:min(k + most - 1, end));
        if what == 2
            of_strain = call.strain;
            if q > 0 % P states of each element follow each other
                of_strain = @(kind, varargin) call.strain(kind, varargin{:}, ...
                    repeated(h(:, of), size(varargin{4}, 2)));
            end
            part = strains(said, of_strain, mask, kind, reshape(x(:, of), 16, n, []), ...
                           y(:, :, of), s(:, of));
        elseif what == 3
            part = energies(call.stress, mask, {kind, x(:, of)}, said.strains, numel(of));
        else
            state = nodes(reshape(x(:, of), 16, n, []), y(:, :, of));
            if q > 0, state = [state, {h(:, of)}]; end
            part = energies(call.force, mask, [{kind}, state], (7 + w) * n, numel(of));
        end
        for i = find(mask)
            part{i} = reshape(part{i}, [], numel(of));
            whole{i}(1:size(part{i}, 1), of) = part{i};
        end
    end
end
values = [whole{1}(:); whole{2}(:); whole{3}(:)];
if ~isreal(values), error('beamwork:refused', 'complex numbers where real ones are due'); end
end

function h = repeated(h, count)
% h(q,N) of each of `count` states (q,count): the states of each element follow each other.
h = reshape(repmat(reshape(h, size(h, 1), 1, []), 1, count / size(h, 2), 1), size(h, 1), []);
end

function values = sections(call, kinds, mask, numbers, x, n, body)
% Place, axes, P, T and H of the sections, as far as the mask asks for them.
N = numel(numbers);
at = reshape(body(1:N), 1, N);
load = reshape(body(N + 1:end), 3, N, 2); % forces, moments
found = cell(1, 5);
for k = 1:N % H is different for each element
    kind = kinds{numbers(k) + 1};
    motion = @(kind, varargin) moved(call.line, kind, repeated(at(k), size(varargin{4}, 2)), varargin);
    state = reshape(x(:, k), 16, n, 1);
    own = strains(struct('strains', 12), motion, [true, false, false], kind, state, zeros(0, n, 1), []);
    R = reshape(own{1}(4:12), 3, 3);
    turned = cross(load(:, k, 2) * [1 1 1], R, 1) / 2;
    part = strains(struct('strains', 12), motion, [false, any(mask(3:5)), mask(5)], kind, state, ...
                   zeros(0, n, 1), [load(:, k, 1); turned(:)]);
    [found{1}(:, k), found{2}(:, k)] = deal(own{1}(1:3), reshape(R.', [], 1));
    if ~any(mask(3:5)), continue; end
    J = part{2}; % (7n,12)
    T = zeros(7 * n, 3);
    for axis = 1:3 % T^T m is half the sum of dR_k . (m x R_k) over the axes R_k
        dR = J(:, 3 * axis + (1:3));
        T = T + cross(ones(7 * n, 1) * R(:, axis).', dR, 2) / 2;
        if mask(5), part{3} = part{3}(:) - reshape(dR * cross_matrix(load(:, k, 2)) * dR.' / 2, [], 1); end
    end
    [found{3}(:, k), found{4}(:, k)] = deal(reshape(J(:, 1:3), [], 1), T(:));
    if mask(5), found{5}(:, k) = part{3}; end
end
values = [];
for i = find(mask), values = [values; found{i}(:)]; end
if ~isreal(values), error('beamwork:refused', 'complex numbers where real ones are due'); end
end

function motion = moved(line, kind, at, state)
% motion(12,N): place and axes.
N = numel(at);
[place, axes] = line(kind, at, state{:});
motion = [sized(place, [3 N], 'line'); reshape(sized(axes, [3 3 N], 'line'), 9, N)];
end

function values = histories(call, kinds, what, numbers, x, y, h, q)
% The histories of undeformed elements, or of accepted states that were reached from h.
N = numel(numbers);
out = zeros(q, N);
for number = unique(numbers)
    of = find(numbers == number);
    state = nodes(reshape(x(:, of), 16, [], numel(of)), y(:, :, of));
    if what == 7
        found = call.commit(kinds{number + 1}, state{:}, h(:, of));
    elseif isfield(call, 'begin')
        found = call.begin(kinds{number + 1}, state{:});
    else
        found = zeros(q, numel(of));
    end
    out(:, of) = sized(found, [q numel(of)], 'begin or commit');
end
values = out(:);
end

function value = sized(value, wanted, name)
size_of = [size(value), ones(1, numel(wanted) - ndims(value))];
if ~isequal(size_of, wanted)
    error('beamwork:refused', '%s returns an array of size %s where %s is due', name, ...
          mat2str(size_of), mat2str(wanted));
end
value = full(double(value));
end

function state = nodes(x, y)
% {r, u, R, a} of x(16,n,N), and s = y(w,n,N) if w > 0.
R = permute(reshape(x(7:15, :, :), 3, 3, size(x, 2), []), [2 1 3 4]);
state = {x(1:3, :, :), x(4:6, :, :), R, reshape(x(16, :, :), size(x, 2), [])};
if size(y, 1) > 0, state{5} = y; end
end

function found = energies(function_of, mask, arguments, m, N)
% {energy(1,N), its gradient(m,N), second derivatives(m,m,N)}, as far as they are asked for.
sizes = {[1 N], [m N], [m m N]};
found = cell(1, find(mask, 1, 'last'));
[found{:}] = function_of(arguments{:});
for i = find(mask)
    found{i} = sized(found{i}, sizes{i}, func2str(function_of));
end
if mask(3), found{3} = permute(found{3}, [2 1 3]); end
end

function found = strains(said, strain, mask, kind, x, y, s)
% {e(m,N), J(c,m,N), H(c,c,N)}, as far as they are asked for; H of s(m,N) times the strains. The c
% coordinates are 7n of the nodes and those of y(w,n,N).
[~, n, N] = size(x);
w = size(y, 1);
c = (7 + w) * n;
% increments as numbers of order one
unit = [kind.length .^ repmat([1 1 1 0 0 0 -1].', n, 1); ones(w * n, 1)];
state = nodes(x, y);
found = cell(1, 3);
if mask(1), found{1} = sized(strain(kind, state{:}), [said.strains N], 'strain'); end
if ~any(mask(2:3)), return; end
tiny = 1e-20; % of complex steps
stride = 2e-3; % of differences of these
[i, j, move, turn, slide] = steps(n, w, tiny, stride, mask(3));
move = move .* reshape(unit(1:7 * n), 7, n);
P = size(move, 3) * N;
at = reshape(x, 16, n, 1, N);
moving = {reshape(at(1:3, :, :, :) + move(1:3, :, :), 3, n, P), ...
          reshape(at(4:6, :, :, :) + move(1:3, :, :), 3, n, P), ...
          reshape(product(turn, reshape(state{3}, 3, 3, n, 1, N)), 3, 3, n, P), ...
          reshape(at(16, :, :, :) + move(7, :, :), n, P)};
if w > 0, moving{5} = reshape(reshape(y, w, n, 1, N) + slide, w, n, P); end
rate = strain(kind, moving{:});
rate = reshape(imag(sized(rate, [said.strains P], 'strain')), [], P / N, N) / tiny;
found{2} = permute(rate(:, 1:c, :), [2 1 3]) ./ unit;
if mask(3) % differences of fourth order, of complex steps
    f = reshape(sum(rate(:, c + 1:end, :) .* permute(s, [1 3 2]), 1), [], 4, N);
    f = (8 * (f(:, 1, :) - f(:, 2, :)) - f(:, 3, :) + f(:, 4, :)) / (12 * stride);
    found{3}([i + c * (j - 1); j + c * (i - 1)], :) = ...
        repmat(reshape(f, [], N) ./ (unit(i) .* unit(j)), 2, 1);
end
end

function [i, j, move, turn, slide] = steps(n, w, tiny, stride, second)
% Complex steps of all coordinates, move(7,n,P), turn(3,3,n,P) and slide(w,n,P): from where they are; for
% second derivatives, those of i where coordinates j have moved by 1, -1, 2, -2 strides, too.
persistent kept;
if isempty(kept), kept = cell(8, 2, 7); end
if isempty(kept{n, 1 + second, 1 + w})
    one = full(eye((7 + w) * n));
    [i, j] = find(tril(one + 1));
    along = 0 * one;
    d = one;
    if second
        along = [along, kron(stride * [1 -1 2 -2], one(:, j))];
        d = [d, repmat(one(:, i), 1, 4)];
    end
    slide = reshape(along(7 * n + 1:end, :) + 1i * tiny * d(7 * n + 1:end, :), w, n, []);
    along = reshape(along(1:7 * n, :), 7, n, []);
    d = reshape(d(1:7 * n, :), 7, n, []);
    psi = along(4:6, :, :); % where they turned by psi, the spatial increment is dexp(psi) d
    t2 = sum(psi .^ 2, 1);
    once = cross(psi, d(4:6, :, :), 1);
    d4 = d(4:6, :, :) + once .* (1 / 2 - t2 / 24) + cross(psi, once, 1) .* (1 / 6 - t2 / 120);
    t = reshape(sqrt(t2), 1, 1, n, []);
    spin = cross_matrix(psi);
    turn = full(eye(3)) + spin .* sine_by_angle(t) + ...
           product(spin, spin) .* sine_by_angle(t / 2) .^ 2 / 2;
    turn = turn + 1i * tiny * product(cross_matrix(d4), turn);
    kept{n, 1 + second, 1 + w} = {i, j, along + 1i * tiny * d, turn, slide};
end
[i, j, move, turn, slide] = kept{n, 1 + second, 1 + w}{:};
end

function A = cross_matrix(v)
% (3,3,n,P) of v(3,n,P): A w = v x w.
v = reshape(v, 3, 1, size(v, 2), []);
o = 0 * v(1, :, :, :);
A = [o, -v(3, :, :, :), v(2, :, :, :); v(3, :, :, :), o, -v(1, :, :, :); ...
     -v(2, :, :, :), v(1, :, :, :), o];
end

function C = product(A, B)
C = A(:, 1, :, :, :) .* B(1, :, :, :, :) + A(:, 2, :, :, :) .* B(2, :, :, :, :) + ...
    A(:, 3, :, :, :) .* B(3, :, :, :, :);
end

function A = transposed(A)
A = permute(A, [2 1 3:ndims(A)]);
end

function y = sine_by_angle(x)
y = sin(x) ./ (x + (x == 0)) + (x == 0);
end

function psi = rotation_vector(T)
% Its complex steps are those of atan2(s, c).
axis = [T(3, 2, :) - T(2, 3, :); T(1, 3, :) - T(3, 1, :); T(2, 1, :) - T(1, 2, :)] / 2;
c = (T(1, 1, :) + T(2, 2, :) + T(3, 3, :) - 1) / 2;
s = sqrt(sum(axis .* axis, 1));
[sr, cr] = deal(real(s), real(c));
angle = atan2(sr, cr) + 1i * (cr .* imag(s) - sr .* imag(c)) ./ (sr .^ 2 + cr .^ 2);
psi = reshape(axis .* (angle ./ (s + (s == 0)) + (s == 0)), 3, []);
end
