% Scenes of tools/bench/peers by Octave's ode15s (and ode15i, which takes them in the form F(t, y, y') = 0).
%
%   octave-cli with_octave.m SCENE FOLDER TOLERANCE ...
%
% writes FOLDER/METHOD@TOLERANCE.csv: CPU time [s] in a first line `# cpu ...`, then rows of time and the scene's records.
1;

function p = problem (scene)
  p.M = 1;
  switch (scene)
    case "maxwell"
      k = 1000; B = 50; w = 2*pi;
      p.stop = 10; p.scale = 50; p.y0 = 0; p.A = -k/B;
      p.drive = @(t) k*sin (w*t);
      p.row = @(t, y) [y(1), 0];
    case "resonance"
      m = 0.7; k = 90; F = 0.02; w = sqrt (k/m);
      p.stop = 16.6; p.scale = 0.01; p.y0 = [0; 0]; p.A = [0, 1; -k/m, 0];
      p.drive = @(t) [0; F/m*sin(w*t)];
      p.row = @(t, y) [k*y(1), y(2)];
    case "ladder"
      n = 100; m = 1e-3; k = 1e3; c = 1;
      D = spdiags ([ones(n, 1), -2*ones(n, 1), ones(n, 1)], -1:1, n, n);
      D(1, 1) = -1;
      even = 1:2:2*n; odd = 2:2:2*n;
      p.A = sparse (2*n, 2*n);
      p.A(even, odd) = speye (n);
      p.A(odd, even) = k/m*D;
      p.A(odd, odd) = c/m*D;
      f = zeros (2*n, 1); f(2) = 1/m;
      p.stop = 0.1; p.scale = 1e-2; p.y0 = zeros (2*n, 1);
      p.drive = @(t) f;
      p.row = @(t, y) [k*(y(1) - y(3)), y(2)];
    otherwise
      error ("no scene %s", scene);
  endswitch
endfunction

function simulate (scene, folder, method, tolerance)
  p = problem (scene);
  times = (0:500)' * p.stop / 500;
  tol = str2double (tolerance);
  begin = cputime ();
  if (strcmp (method, "ode15s"))
    options = odeset ("RelTol", tol, "AbsTol", tol*p.scale, "Jacobian", p.A);
    [t, y] = ode15s (@(t, y) p.A*y + p.drive (t), times, p.y0, options);
  else
    E = speye (numel (p.y0));
    if (numel (p.y0) < 10) E = full (E); endif
    jacobian = @(t, y, yp) deal (-p.A, E);
    options = odeset ("RelTol", tol, "AbsTol", tol*p.scale, "Jacobian", {-p.A, E});
    [t, y] = ode15i (@(t, y, yp) yp - p.A*y - p.drive (t), times, p.y0, p.A*p.y0 + p.drive (0), options);
  endif
  seconds = cputime () - begin;
  if (numel (t) != numel (times)) error ("stops at %g s", t(end)); endif
  out = fopen (sprintf ("%s/Octave %s@%s.csv", folder, method, tolerance), "w");
  fprintf (out, "# cpu %.9g\n", seconds);
  for i = 1:numel (t)
    fprintf (out, "%.17g,%.17g,%.17g\n", t(i), p.row (t(i), y(i, :)'));
  endfor
  fclose (out);
endfunction

given = argv ();
for method = {"ode15s", "ode15i"}
  for i = 3:numel (given)
    try
      simulate (given{1}, given{2}, method{1}, given{i});
    catch problem_met
      fprintf (stderr, "%s at %s: %s\n", method{1}, given{i}, problem_met.message);
      break;
    end_try_catch
  endfor
endfor
