// For Unity: put it on an object; the object's place is the hand, and the force of the scene on it is in ForceNewtons.
// Everything happens in FixedUpdate, so that nothing needs a lock.
using UnityEngine;

namespace Myotact
{
    public sealed class MyotactHand : MonoBehaviour
    {
        public string Host = "127.0.0.1";
        public int Port = 7480;
        /// Metres of the simulation to a unit of the engine.
        public float MetresPerUnit = 0.1f;
        /// In the engine's axes.
        public Vector3 ForceNewtons;

        MyotactClient client;
        ulong sequence;
        ulong pingedNs;

        void OnEnable()
        {
            client = new MyotactClient(Host, Port, Role.Student, Wants.Hand);
            if (client.Hand < 0) Debug.LogWarning("Myotact: no hand of the scene is free");
        }

        void OnDisable()
        {
            if (client != null) client.Dispose();
            client = null;
            ForceNewtons = new Vector3(0, 0, 0);
        }

        void FixedUpdate()
        {
            if (client == null || client.Hand < 0) return;
            try
            {
                Exchange();
            }
            catch (System.Exception failure)
            {
                Debug.LogWarning("Myotact: " + failure.Message);
                OnDisable();
            }
        }

        void Exchange()
        {
            Vector3 place = transform.position;
            double[] world = WorldAxes.ToWorld(new double[] { place.x, place.y, place.z });
            for (int i = 0; i < 3; ++i) world[i] *= MetresPerUnit;
            client.Tell(new ToolState { PositionWorldM = world, ProxyWorldM = world, Sequence = ++sequence }, MyotactClient.NowNs());
            if (MyotactClient.NowNs() - pingedNs > 100000000)
            {
                client.Ping();
                pingedNs = MyotactClient.NowNs();
            }
            while (client.HasFrame)
            {
                Frame frame = client.Read();
                if (frame.Type != FrameType.Force) continue;
                double[] force = WorldAxes.ToEngine(MyotactClient.ForceOf(frame).WorldN);
                ForceNewtons = new Vector3((float)force[0], (float)force[1], (float)force[2]);
            }
        }
    }
}
