// Leads a hand round in a scene of a server, as `spring`, and prints what it feels: DriveSpring HOST:PORT
// The server's token, where it asks for one, is in MYOTACT_TOKEN.
using System;
using System.Globalization;
using System.Threading;

namespace Myotact
{
    static class DriveSpring
    {
        const double RadiusM = 0.03;
        const int StepsOfTurn = 100, Steps = 2 * StepsOfTurn, PeriodMs = 10;

        static void LeadRound(MyotactClient client)
        {
            if (client.Hand < 0) throw new WireException("all hands of the scene are taken");
            Console.WriteLine("x_m,y_m,force_x_N,force_y_N");
            for (int i = 0; i < Steps; ++i)
            {
                double angle = 2 * Math.PI * i / StepsOfTurn;
                var hand = new[] { RadiusM * Math.Cos(angle), RadiusM * Math.Sin(angle), 0.0 };
                var state = new ToolState { PositionWorldM = hand, ProxyWorldM = hand, Sequence = (ulong)i + 1 };
                client.SendState(state, MyotactClient.NowNs());
                double[] force = MyotactClient.ForceOf(client.ReadUntil(FrameType.Force)).WorldN;
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0:F5},{1:F5},{2:F4},{3:F4}", hand[0], hand[1],
                                                force[0], force[1]));
                if (!client.IsLockstep) Thread.Sleep(PeriodMs);
            }
        }

        static int Main(string[] arguments)
        {
            string address = arguments.Length == 1 ? arguments[0] : "";
            int colon = address.LastIndexOf(':'), port;
            if (colon < 1 || !int.TryParse(address.Substring(colon + 1), out port) || port < 1 || port > 65535)
            {
                Console.Error.WriteLine("usage: DriveSpring HOST:PORT, with a port of 1 to 65535");
                return 2;
            }
            try
            {
                byte[] token = MyotactClient.TokenOf(Environment.GetEnvironmentVariable("MYOTACT_TOKEN"));
                string host = address.Substring(0, colon);
                using (var client = new MyotactClient(host, port, Role.Student, Wants.Hand, token)) LeadRound(client);
                return 0;
            }
            catch (WireException failure)
            {
                Console.Error.WriteLine(failure.Message);
                return 1;
            }
        }
    }
}
