// Between the world of the simulation (right-handed: x cranial, y left, z up) and that of a left-handed engine with y up
// (Unity: x right, y up, z forward), looking cranially: engine x = -y, engine y = z, engine z = x. For places and
// forces; a body's pose is for places of the world: turn what it gives.
namespace Myotact
{
    public static class WorldAxes
    {
        public static double[] ToEngine(double[] world)
        {
            return new[] { -world[1], world[2], world[0] };
        }

        public static double[] ToWorld(double[] engine)
        {
            return new[] { engine[2], -engine[0], engine[1] };
        }

        /// Corners that run counter-clockwise seen from outside, in the order of an engine whose fronts run clockwise.
        public static int[] Triangle(int a, int b, int c)
        {
            return new[] { a, c, b };
        }
    }
}
