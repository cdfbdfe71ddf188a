% Matlab and GNU Octave scripts for the results of CONTACT.
%
% Loading results.
%
%   loadcase        - load the surface results of one case.
%   diffcase        - difference of the results of two cases.
%   loadstrs        - load displacements and stresses below the surface.
%   diffstrs        - difference of stresses below the surface of two cases.
%   parse_out1      - read overall results of wheel-rail cases (module 1) from an .out file.
%   parse_out3      - read overall results of basic contact cases (module 3) from an .out file.
%
% Plotting results.
%
%   plot2d          - tractions along rows or columns of the contact area.
%   plot3d          - all kinds of results for the whole contact area, also on rails and wheels.
%   plotstrs        - displacements and stresses below the surface.
%
% Wheel and rail profiles.
%
%   read_profile    - read a profile of any kind.
%   read_slices     - read a profile that varies along the rail or around the wheel.
%   read_simpack    - read a Simpack file (prr, prw).
%   read_miniprof   - read a Miniprof file (ban, whl) or a table.
%   modify_profile  - mirror, scale and order the points of a profile.
%   resample_slices - corresponding points on the slices of a varying profile.
%   write_simpack   - write a Simpack file.
%   write_miniprof  - write a Miniprof file.
