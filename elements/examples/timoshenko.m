% A shear-deformable beam of two nodes: strains uniform along the element [m],
%   d = Rm.' (rq - rp) - (l, 0, 0), Rm half way from Rp to Rq, and l log(Rp.' Rq).
% The physics is that of timoshenko.c in this folder.
%   beamwork converge tapered_cantilever --element 'exec:octave-cli -qf timoshenko.m' -f all
1; % a script, though functions stand first

function C = prepare(kind)
% Its stiffness [N/m]: sigma = C e.
c = kind.section;
l = kind.length;
% Forces across: shear where it is asked for, and bending that a uniform curvature lacks.
shear = kind.features.shear * l / c.shear_modulus;
across_y = shear * c.F(1, 1) + l^3 / (12 * c.young * c.Iz);
across_z = shear * c.F(2, 2) + l^3 / (12 * c.young * c.Iy);
C = diag([c.young * c.A / l, 1 / across_y, 1 / across_z, c.shear_modulus * c.It / l^3, ...
          c.young * c.Iy / l^3, c.young * c.Iz / l^3]);
end

function e = strain(kind, r, u, R, a)
% e(6,N) of r(3,2,N) and R(3,3,2,N); also of complex steps.
chord = r(:, 2, :) - r(:, 1, :);
[Rp, Rq] = deal(turned_back(R(:, :, 1, :)), turned_back(R(:, :, 2, :)));
p = beamwork_element('product', Rp, chord); % the chord in the axes of both nodes
q = beamwork_element('product', Rq, chord);
T = beamwork_element('product', Rp, beamwork_element('transpose', Rq));
psi = beamwork_element('rotation_vector', T);
[p, q] = deal(reshape(p, 3, []), reshape(q, 3, []));
% Across psi their mean is that of the middle, shortened by c; along it all are the same.
angle = sqrt(sum(psi .* psi, 1));
c = cos(angle / 2);
bent = beamwork_element('sinc', angle / 4) .^ 2 ./ (8 * c);
e = [(p + q) ./ (2 * c) - bent .* sum(psi .* p, 1) .* psi - [kind.length; 0; 0]; kind.length * psi];
end

function A = turned_back(R)
A = beamwork_element('transpose', reshape(R, 3, 3, []));
end

addpath(fileparts(mfilename('fullpath')));
beamwork_element(@prepare, 'strain', @strain, 'strains', 6, ...
    'name', 'timoshenko_m', 'family', 'example', ...
    'summary', 'two nodes, one integration point, flexible in shear, no warping, in Octave', ...
    'source', 'Reissner, J. Appl. Math. Phys. 32 (1981), one point of integration', ...
    'offers', {'shear', 'geometric', 'large rotations', 'mass', 'rotary inertia'}, ...
    'shear_theories', {'haringx'}, 'limits', {'doubly symmetric'});
