% Steady rolling of a cylinder: tractions of the truncated 2D problem and Carter's solution
s = loadcase('carter2d');
plot2d(s);
hold on
a  = 1;                                 % half-width of the contact [mm]
ad = 0.6;                               % half-width of the adhesion area, which begins at the leading edge x = a
x  = linspace(-a, a, 401);
p0 = max(s.trcbnd);
px = p0/a * (sqrt(a^2-x.^2) - sqrt(max(0, ad^2-(x-a+ad).^2)));
plot(x, px, 'k-');
legend('bound', 'p_x', 'Carter');
