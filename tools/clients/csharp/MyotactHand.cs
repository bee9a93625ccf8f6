// For Unity: put it on an object; the object's place is the hand, and the force of the scene on it is in ForceNewtons.
// Everything happens in FixedUpdate, so that nothing needs a lock. When the connection breaks it switches itself off;
// switched on again it connects again.
using UnityEngine;

namespace Myotact
{
    public sealed class MyotactHand : MonoBehaviour
    {
        public string Host = "127.0.0.1";
        public int Port = 7480;
        /// 32 hexadecimal digits, as a server prints them that lets other machines join; else nothing.
        public string Token = "";
        /// Metres of the simulation to a unit of the engine.
        public float MetresPerUnit = 0.1f;
        /// In the engine's axes. Zero when nothing has come for 100 ms.
        public Vector3 ForceNewtons;

        const ulong StaleNs = 100000000, PingPeriodNs = 100000000;

        MyotactClient client;
        ulong sequence, pingedNs, feltNs;

        void OnEnable()
        {
            try
            {
                client = new MyotactClient(Host, Port, Role.Student, Wants.Hand, MyotactClient.TokenOf(Token));
                if (client.Hand < 0) throw new WireException("all hands of the scene are taken");
            }
            catch (WireException failure)
            {
                GiveUp(failure);
            }
        }

        void OnDisable()
        {
            if (client != null) client.Dispose();
            client = null;
            ForceNewtons = new Vector3(0, 0, 0);
        }

        void FixedUpdate()
        {
            try
            {
                Feel();  // first: a server that goes has said why
                SendState();
            }
            catch (WireException failure)
            {
                GiveUp(failure);
            }
        }

        void GiveUp(WireException failure)
        {
            Debug.LogWarning("Myotact: " + failure.Message);
            enabled = false;  // the engine calls OnDisable
        }

        void Feel()
        {
            while (client.HasFrame)
            {
                Frame frame = client.Read();
                if (frame.Type != FrameType.Force) continue;
                double[] force = WorldAxes.ToEngine(MyotactClient.ForceOf(frame).WorldN);
                ForceNewtons = new Vector3((float)force[0], (float)force[1], (float)force[2]);
                feltNs = MyotactClient.NowNs();
            }
            if (MyotactClient.NowNs() - feltNs > StaleNs) ForceNewtons = new Vector3(0, 0, 0);
        }

        void SendState()
        {
            Vector3 place = transform.position;
            double[] world = WorldAxes.ToWorld(new double[] { place.x, place.y, place.z });
            for (int i = 0; i < 3; ++i) world[i] *= MetresPerUnit;
            var state = new ToolState { PositionWorldM = world, ProxyWorldM = world, Sequence = ++sequence };
            client.SendState(state, MyotactClient.NowNs());
            if (MyotactClient.NowNs() - pingedNs < PingPeriodNs) return;
            client.Ping();
            pingedNs = MyotactClient.NowNs();
        }
    }
}
